/// \file
/// The picture in progress, shown by tev (https://github.com/Tom94/tev) or whatever speaks its
/// protocol: packets over TCP, each a length (four bytes, itself included), a kind (one byte) and
/// what belongs to it; numbers are little-endian, texts end in a zero byte.
#pragma once

#include <cstdint>
#include <string>

#include "render/render.h"

namespace portalens {

struct DisplayAddress {
  std::string host = "127.0.0.1";
  std::string port = "14158";  ///< tev's own
};

/// "host:port", "host" or ":port"; an IPv6 address with a port stands in brackets.
[[nodiscard]] DisplayAddress display_address(const std::string& text);

/// Kind 4: an empty picture of R, G, B.
[[nodiscard]] std::string create_image_packet(const std::string& name, int width, int height);

/// Kind 6: a tile's pixels of R, G, B.
/// @param film  the picture of `window`, in which the tile lies
[[nodiscard]] std::string update_image_packet(const std::string& name, const Window& tile,
                                              const Image& film, const Window& window);

/// Sends each tile when it stands. A server that goes away, or takes nothing for some seconds, is
/// given up, and the work goes on.
class DisplayServer : public Progress {
 public:
  /// @throws WorkError if nobody listens there
  DisplayServer(const DisplayAddress& address, std::string name, const Window& window);
  ~DisplayServer() override;
  DisplayServer(const DisplayServer&) = delete;
  DisplayServer& operator=(const DisplayServer&) = delete;

  void advanced(std::size_t done, std::size_t total, const Tally& tally) override;
  void tile_taken(const Window& tile, const Image& film, const Window& window) override;

  /// Whether everything was sent so far.
  [[nodiscard]] bool connected() const { return socket_ >= 0; }

 private:
  void send(const std::string& packet);

  std::string name_;
  int socket_ = -1;
};

}  // namespace portalens
