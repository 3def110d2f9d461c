#include "app/spooled_input.h"

#include <stdlib.h>

#include <cerrno>
#include <cstdint>
#include <string>
#include <system_error>

#include "io/files.h"

namespace portalens {

SpooledInput::SpooledInput(const std::filesystem::path& file) : file_(file) {
  if (file != standard_stream) return;
  constexpr std::uint64_t most = std::uint64_t{1} << 30;
  Faults faults;
  const auto bytes = read_file(file, most, {}, faults);
  faults.raise();
  std::string folder = (std::filesystem::temp_directory_path() / "portalens-XXXXXX").string();
  if (!::mkdtemp(folder.data()))
    throw WorkError("can't write in " + std::filesystem::temp_directory_path().string() + ": " +
                    std::generic_category().message(errno));
  folder_ = folder;
  file_ = folder_ / "stdin";
  replace_file(file_, *bytes);
}

SpooledInput::~SpooledInput() {
  std::error_code ignored;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
}

}  // namespace portalens
