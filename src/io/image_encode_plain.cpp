// Pictures encoded without libraries, in builds without them (PORTALENS_PORTABLE).
#include "io/image_encode.h"
#include "io/plain_pictures.h"

namespace portalens {

std::vector<unsigned char> encode_exr(const EncodedPicture& picture) { return plain_exr(picture); }

std::vector<unsigned char> encode_png(const EncodedPicture& picture) { return plain_png(picture); }

bool encodes_jpeg() { return false; }

std::vector<unsigned char> encode_jpeg(const EncodedPicture& picture) {
  throw WorkError("can't encode " + picture.file.string() + ": this build writes no JPEG");
}

}  // namespace portalens
