#include "differential/find.h"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace portalens::differential {

KeptFind read_find(const std::filesystem::path& file) {
  KeptFind find{file, {}};
  bool told = false;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    find.open |= line == "# open";
    if (line.rfind("# within ", 0) == 0) find.tolerances = std::stod(line.substr(9));
    const auto ray = line.find(" --ray ");
    if (line.rfind("# ", 0) != 0 || ray == std::string::npos) continue;
    std::istringstream numbers(line.substr(ray + 7));
    Vec3d &x = find.photon.position, &d = find.photon.direction;
    told = static_cast<bool>(numbers >> x.x >> x.y >> x.z >> d.x >> d.y >> d.z);
  }
  if (!told) throw std::runtime_error(file.string() + ": no line tells the photon");
  find.photon.direction = normalize(find.photon.direction);
  return find;
}

Difference difference_of(const KeptFind& find, Engine engine) {
  const Stage stage = set_up(find.file);
  Arrival arrival;
  advance(stage.own.space, {&find.photon, 1}, {&arrival, 1}, engine);
  return difference_of(stage, find.photon, arrival, exact_arrival(stage, find.photon));
}

}  // namespace portalens::differential
