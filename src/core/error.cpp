#include "core/error.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "core/words.h"

namespace portalens {
namespace {

constexpr std::size_t max_told = 1000;  // nobody reads more

const std::string& file_of(const Location& where) {
  static const std::string command_line = "command line";
  return where.file ? *where.file : command_line;
}

std::string joined(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) {
    if (!text.empty()) text += '\n';
    text += to_string(fault);
  }
  return text;
}

std::vector<Fault> sorted(std::vector<Fault> faults) {
  std::stable_sort(faults.begin(), faults.end(), [](const Fault& a, const Fault& b) {
    return std::tie(file_of(a.where), a.where.line) < std::tie(file_of(b.where), b.where.line);
  });
  if (faults.size() > max_told) {
    const Location where{faults[max_told].where.file, 0};
    const std::string rest = std::to_string(faults.size() - max_told);
    faults.resize(max_told);
    faults.push_back({where, rest + " more faults", "mend these first"});
  }
  return faults;
}

}  // namespace

std::string to_string(const Fault& fault) {
  std::string text = file_of(fault.where);
  if (fault.where.line > 0) text.append(":").append(std::to_string(fault.where.line));
  text.append(": ").append(fault.problem);
  if (!fault.remedy.empty()) text.append("; ").append(fault.remedy);
  return harmless(std::move(text));
}

SceneError::SceneError(std::vector<Fault> faults)
    : std::runtime_error(joined(sorted(faults))), faults_(sorted(std::move(faults))) {}

void refuse(std::string problem, std::string remedy) {
  throw SceneError({{Location{}, std::move(problem), std::move(remedy)}});
}

void Faults::add(Location where, std::string problem, std::string remedy) {
  faults_.push_back({std::move(where), std::move(problem), std::move(remedy)});
}

void Faults::replace(std::size_t index, Location where, std::string problem, std::string remedy) {
  faults_[index] = {std::move(where), std::move(problem), std::move(remedy)};
}

void Faults::raise() const {
  if (!faults_.empty()) throw SceneError(faults_);
}

}  // namespace portalens
