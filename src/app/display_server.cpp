#include "app/display_server.h"

#include <netdb.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <memory>
#include <utility>

#include "core/error.h"

namespace portalens {
namespace {

constexpr time_t patience = 5;  // seconds

enum class PacketKind : std::uint8_t { create_image = 4, update_image = 6 };

/// A packet under construction.
class Packet {
 public:
  explicit Packet(PacketKind kind) : bytes_(4, '\0') { add(static_cast<char>(kind)); }

  void add(char byte) { bytes_ += byte; }
  void add(const std::string& text) { bytes_.append(text.c_str(), text.size() + 1); }
  void add(std::int32_t number) { add_bits(static_cast<std::uint32_t>(number), 4); }
  void add(std::int64_t number) { add_bits(static_cast<std::uint64_t>(number), 8); }
  void add(float number) { add_bits(std::bit_cast<std::uint32_t>(number), 4); }

  /// The whole, with its length in front.
  [[nodiscard]] std::string done() && {
    const auto size = static_cast<std::uint32_t>(bytes_.size());
    for (std::size_t i = 0; i < 4; ++i) bytes_[i] = static_cast<char>(size >> 8 * i & 0xff);
    return std::move(bytes_);
  }

 private:
  void add_bits(std::uint64_t bits, int count) {
    for (int i = 0; i < count; ++i) add(static_cast<char>(bits >> 8 * i & 0xff));
  }

  std::string bytes_;
};

constexpr std::array<const char*, 3> channel_letters = {"R", "G", "B"};

/// A socket that is connected to the address.
int connected_socket(const DisplayAddress& address) {
  const std::string place = address.host + ":" + address.port;
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int code = ::getaddrinfo(address.host.c_str(), address.port.c_str(), &hints, &found);
  if (code != 0)
    throw WorkError("no display server at " + place + ": " + std::string(::gai_strerror(code)));
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> list(found, &::freeaddrinfo);
  int reason = 0;
  for (const addrinfo* one = found; one; one = one->ai_next) {
    const int number = ::socket(one->ai_family, one->ai_socktype | SOCK_CLOEXEC, one->ai_protocol);
    if (number < 0) {
      reason = errno;
      continue;
    }
    const timeval limit{patience, 0};
    ::setsockopt(number, SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
    if (::connect(number, one->ai_addr, one->ai_addrlen) == 0) return number;
    reason = errno;
    ::close(number);
  }
  throw WorkError("no display server at " + place + ": " + std::strerror(reason));
}

}  // namespace

DisplayAddress display_address(const std::string& text) {
  DisplayAddress address;
  std::string host = text;
  const std::size_t colon = text.rfind(':');
  const std::size_t bracket = text.rfind(']');
  const bool has_port = colon != std::string::npos &&
                        (bracket == std::string::npos ? text.find(':') == colon : colon > bracket);
  if (has_port) {
    host = text.substr(0, colon);
    if (colon + 1 < text.size()) address.port = text.substr(colon + 1);
  }
  if (host.size() >= 2 && host.front() == '[' && host.back() == ']')
    host = host.substr(1, host.size() - 2);
  if (!host.empty()) address.host = host;
  return address;
}

std::string create_image_packet(const std::string& name, int width, int height) {
  Packet packet(PacketKind::create_image);
  packet.add('\1');  // show it
  packet.add(name);
  packet.add(std::int32_t{width});
  packet.add(std::int32_t{height});
  packet.add(static_cast<std::int32_t>(channel_letters.size()));
  for (const char* letter : channel_letters) packet.add(std::string(letter));
  return std::move(packet).done();
}

std::string update_image_packet(const std::string& name, const Window& tile, const Image& film,
                                const Window& window) {
  Packet packet(PacketKind::update_image);
  packet.add('\0');
  packet.add(name);
  packet.add(static_cast<std::int32_t>(channel_letters.size()));
  for (const char* letter : channel_letters) packet.add(std::string(letter));
  packet.add(std::int32_t{tile.x0 - window.x0});
  packet.add(std::int32_t{tile.y0 - window.y0});
  packet.add(std::int32_t{tile.width()});
  packet.add(std::int32_t{tile.height()});
  // Pixel by pixel: where each channel begins, and how far its values lie apart.
  for (std::int64_t channel = 0; channel < 3; ++channel) packet.add(channel);
  for (int channel = 0; channel < 3; ++channel) packet.add(std::int64_t{3});
  for (int y = tile.y0; y < tile.y1; ++y) {
    const float* row = film.at(tile.x0 - window.x0, y - window.y0);
    for (int i = 0; i < 3 * tile.width(); ++i) packet.add(row[i]);
  }
  return std::move(packet).done();
}

DisplayServer::DisplayServer(const DisplayAddress& address, std::string name, const Window& window)
    : name_(std::move(name)), socket_(connected_socket(address)) {
  send(create_image_packet(name_, window.width(), window.height()));
}

DisplayServer::~DisplayServer() {
  if (socket_ >= 0) ::close(socket_);
}

void DisplayServer::advanced(std::size_t, std::size_t, const Tally&) {}

void DisplayServer::tile_taken(const Window& tile, const Image& film, const Window& window) {
  if (connected()) send(update_image_packet(name_, tile, film, window));
}

void DisplayServer::send(const std::string& packet) {
  for (std::size_t sent = 0; sent < packet.size();) {
    const ssize_t count = ::send(socket_, packet.data() + sent, packet.size() - sent, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      ::close(std::exchange(socket_, -1));
      return;
    }
    sent += static_cast<std::size_t>(count);
  }
}

}  // namespace portalens
