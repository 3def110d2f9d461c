/// \file
/// Reading `[[portal]]` tables, and joining them in pairs. equations.md, sec. 4.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "portal/portal.h"
#include "world/mass_reader.h"
#include "world/material_list.h"

namespace portalens {

/// Reads the portals of a scene one by one, then joins them.
class PortalReader {
 public:
  explicit PortalReader(Faults& faults) : faults_(&faults) {}

  /// Reads all keys of a portal's table but `name`. A massive portal adds to `masses`.
  void read(Parameters& parameters, const std::string& name, MaterialList& materials,
            const Physics& physics, std::vector<Mass>& masses);

  /// The portals, each with its pair and the passage to it. Whatever hinders that is a fault.
  [[nodiscard]] std::vector<Portal> join();

 private:
  struct Read {
    Portal portal;
    std::string pair;
    Location where, shape, pair_where, back;
    FaceInput face;
    bool by_size = false;  ///< not by its corners or radii
    bool sound = false;    ///< it has a face
  };

  [[nodiscard]] std::optional<std::uint32_t> partner(std::uint32_t index) const;
  void check_backs(const Read& a, const Read& b) const;
  void check_congruent(const Read& a, const Read& b) const;
  [[nodiscard]] static std::string remedy_for(const Read& first, const Read& second);
  [[nodiscard]] static std::string face_of(const Read& read);

  Faults* faults_;
  std::vector<Read> portals_;
  std::unordered_map<std::string, std::uint32_t> by_name_;
};

}  // namespace portalens
