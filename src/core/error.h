/// \file
/// A user's fault, and the one exception that carries all the faults of a scene.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace portalens {

/// A place in a file. Line 0 means the file as a whole; a null file the command line.
struct Location {
  std::shared_ptr<const std::string> file;
  int line = 0;
};

/// One mistake of the user's: what is wrong, and what would be right.
struct Fault {
  Location where;
  std::string problem;
  std::string remedy;
};

/// `file:line: problem; remedy`, as the user reads it: one line, without control characters.
[[nodiscard]] std::string to_string(const Fault& fault);

/// All the faults of a scene, sorted by file and line; after the first thousand only their number.
/// Thrown by readers and by `compile`, caught once, in `app`.
class SceneError : public std::runtime_error {
 public:
  explicit SceneError(std::vector<Fault> faults);
  [[nodiscard]] const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

/// Refuses what the command line asks for.
/// @throws SceneError  always, with this one fault
[[noreturn]] void refuse(std::string problem, std::string remedy);

/// Collects faults so that a file is told all of its mistakes in one go.
class Faults {
 public:
  void add(Location where, std::string problem, std::string remedy);
  /// Puts a fault in place of the one that was the `index`th to be added.
  void replace(std::size_t index, Location where, std::string problem, std::string remedy);
  [[nodiscard]] bool empty() const { return faults_.empty(); }
  [[nodiscard]] std::size_t size() const { return faults_.size(); }

  /// @throws SceneError with every fault collected, if there is any.
  void raise() const;

 private:
  std::vector<Fault> faults_;
};

/// Something outside the scene that failed while working: a disk, a folder, memory.
class WorkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace portalens
