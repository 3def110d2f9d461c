/// \file
/// What escaped light comes from: a colour all round, or an equirectangular sky.
#pragma once

#include <memory>
#include <vector>

#include "shading/sky_disc.h"
#include "shading/texture.h"

namespace portalens {

/// A sky's centre is -z, +x lies to the right of it, +y on top; `rotation` turns it about +y.
struct Environment {
  Rgb color{0.2, 0.3, 0.5};
  std::shared_ptr<const Image> image;  ///< in place of the colour, if there is one
  Rgb scale{1, 1, 1};                  ///< by which the image is multiplied
  double rotation = 0.0;               ///< degrees, right-handed about +y
  std::vector<SkyDisc> discs{};        ///< that shine beside either
  bool lights = false;                 ///< surfaces, too

  /// Keys color, image and rotation, and intensity, by which either is multiplied; of an image the
  /// colour scales the channels. `lights`: true of an image, else false, if it is not given.
  static Environment from(Parameters& parameters, const ImageLoader& load);
  /// @param direction  unit vector towards the sky
  [[nodiscard]] Rgb radiance(Vec3d direction) const;
  /// The same without the discs.
  [[nodiscard]] Rgb radiance_beside_discs(Vec3d direction) const;

  /// The direction that is seen at a place of the image, from its top left: both 0 to 1 over it.
  [[nodiscard]] Vec3d direction_of(double right, double down) const;
  /// What is seen there, but for the discs.
  [[nodiscard]] Rgb radiance_at(double right, double down) const;
};

/// Whether nothing is to be seen of it, but for the discs.
[[nodiscard]] bool is_black(const Environment& sky);

}  // namespace portalens
