#include "io/paths.h"

#include <algorithm>
#include <system_error>

#include "core/words.h"

namespace portalens {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

bool lies_in(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first ==
         folder.end();
}

}  // namespace

std::optional<fs::path> resolve_file(const fs::path& scene_file, const std::string& name,
                                     Containment containment, const Location& asked_at,
                                     Faults& faults) {
  const auto refuse = [&](const std::string& problem, const std::string& remedy) {
    faults.add(asked_at, problem, remedy);
    return std::nullopt;
  };
  const std::string stay_inside =
      "name a file in that folder, or allow files from anywhere by --allow-outside-files";
  if (name.empty()) return refuse("a file's name is empty", "name a file beside the scene");
  if (name.find('\0') != std::string::npos) {
    return refuse("a file's name contains a zero", "name a file beside the scene");
  }
  std::error_code error;
  const fs::path folder = fs::canonical(folder_of(scene_file), error);
  if (error) return refuse("can't find the scene's folder: " + error.message(), "check its path");
  const fs::path wanted = (folder / name).lexically_normal();
  // Asked before the disk is: what lies outside must not even be probed.
  if (containment == Containment::scene_folder && !lies_in(wanted, folder)) {
    return refuse("the path " + in_quotes(name) + " leaves the folder of the file that names it",
                  stay_inside);
  }
  const fs::path file = fs::canonical(folder / name, error);
  if (error == std::errc::no_such_file_or_directory || error == std::errc::not_a_directory) {
    return refuse("there is no file " + in_quotes(name),
                  "a path is relative to the file that names it");
  }
  if (error)
    return refuse("can't find " + in_quotes(name) + ": " + error.message(), "check its path");
  if (containment == Containment::scene_folder && !lies_in(file, folder)) {
    return refuse(
        "the path " + in_quotes(name) + " leaves the folder of the file that names it by a link",
        stay_inside);
  }
  if (!fs::is_regular_file(file, error)) {
    return refuse(in_quotes(name) + " is not a regular file",
                  "name a file, not a folder or a device");
  }
  return file;
}

bool is_missing(const fs::path& scene_file, const std::string& name) {
  std::error_code error;
  const fs::path folder = fs::canonical(folder_of(scene_file), error);
  if (error || name.empty() || name.find('\0') != std::string::npos) return false;
  if (!lies_in((folder / name).lexically_normal(), folder)) return false;
  return fs::symlink_status(folder / name, error).type() == fs::file_type::not_found;
}

}  // namespace portalens
