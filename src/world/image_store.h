/// \file
/// The images of a scene, each read once, within a budget of memory.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "io/digest.h"
#include "io/paths.h"
#include "shading/texture.h"

namespace portalens {

class ImageStore {
 public:
  /// @param digests  gets those of the files that are read
  ImageStore(Containment containment, Faults& faults, Digests& digests)
      : containment_(containment), faults_(&faults), digests_(&digests) {}

  /// A loader for the images that `file` names. Borrows the store.
  [[nodiscard]] ImageLoader loader(const std::filesystem::path& file);

  /// Of the images in which negative values became 0: light is never less than none.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::shared_ptr<const Image> load(const std::filesystem::path& file, const std::string& name,
                                    const Location& asked_at);

  Containment containment_;
  Faults* faults_;
  Digests* digests_;
  std::map<std::filesystem::path, std::shared_ptr<const Image>> images_;
  std::vector<std::string> warnings_;
  std::size_t bytes_ = 0;
};

}  // namespace portalens
