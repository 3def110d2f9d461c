/// \file
/// What goes wrong: faults as data, and the one exception that this library throws.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace portalens::api {

/// One mistake in a scene, or in what was asked for: where, what is wrong, what would be right.
struct Fault {
  std::string file;  ///< the scene's file, or the source file that built it; may be empty
  int line = 0;      ///< in it, from 1; 0: the file as a whole
  std::string problem;
  std::string remedy;  ///< may be empty where nothing better is known
};

/// `file:line: problem; remedy`, on one line and without control characters.
[[nodiscard]] std::string to_string(const Fault& fault);

/// Who can mend it.
enum class Cause {
  asked,  ///< what was asked for: the scene, or an argument
  work,   ///< what the machine could not do: a disk, a folder, memory
};

/// The only exception that functions of this library throw of their own. It carries all the faults
/// of a scene at once, by file and line. What a caller's own callback throws goes through
/// unchanged.
class Error : public std::runtime_error {
 public:
  Error(Cause cause, std::vector<Fault> faults);
  Error(const Error&) = default;
  Error& operator=(const Error&) = default;
  ~Error() override;

  [[nodiscard]] Cause cause() const noexcept { return cause_; }
  /// At least one. `what()` is all of them, a line each.
  [[nodiscard]] const std::vector<Fault>& faults() const noexcept { return faults_; }

 private:
  Cause cause_;
  std::vector<Fault> faults_;
};

}  // namespace portalens::api
