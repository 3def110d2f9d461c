/// \file
/// `portalens render --display-server`: what a listener is told.
#include "app/display_server.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <string>
#include <thread>

#include "io/image.h"
#include "support/run_program.h"

namespace portalens {
namespace {

/// Listens on a free port of the loopback, and keeps what the first caller says until it hangs up.
class Listener {
 public:
  Listener() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::listen(socket_, 1), 0);
    socklen_t size = sizeof address;
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = std::to_string(ntohs(address.sin_port));
  }
  ~Listener() {
    if (thread_.joinable()) thread_.join();
    ::close(socket_);
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  [[nodiscard]] const std::string& port() const { return port_; }
  /// @param most  bytes after which it hangs up
  void hear(std::size_t most = std::size_t{1} << 30) {
    thread_ = std::thread([this, most] {
      const int caller = ::accept(socket_, nullptr, nullptr);
      char buffer[4096];
      while (heard_.size() < most) {
        const ssize_t count = ::recv(caller, buffer, sizeof buffer, 0);
        if (count <= 0) break;
        heard_.append(buffer, static_cast<std::size_t>(count));
      }
      ::close(caller);
    });
  }
  std::string heard() {
    thread_.join();
    return heard_;
  }

 private:
  int socket_;
  std::string port_, heard_;
  std::thread thread_;
};

/// Reads a packet as the protocol says, and fails the test where it is too short.
class Reader {
 public:
  explicit Reader(std::string bytes) : bytes_(std::move(bytes)) {}

  template <class Number>
  Number number() {
    Number value{};
    if (at_ + sizeof value > bytes_.size()) {
      ADD_FAILURE() << "the packet ends too early";
      return value;
    }
    bytes_.copy(reinterpret_cast<char*>(&value), sizeof value, at_);
    at_ += sizeof value;
    return value;
  }
  std::string text() {
    const std::string value = bytes_.c_str() + at_;
    at_ += value.size() + 1;
    return value;
  }
  [[nodiscard]] bool done() const { return at_ == bytes_.size(); }
  std::string take(std::size_t count) {
    const std::string part = bytes_.substr(at_, count);
    at_ += count;
    return part;
  }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

const std::string lit_scene = R"(camera = { position = [0, 0, 5], look_at = [0, 0, 0] }
film = { width = 21, height = 13 }
sphere = [{ center = [0, 0, 0], radius = 1, mass = 100 }]
environment = { color = [0.25, 0.5, 0.75] }
)";

TEST(DisplayServer, IsToldEveryPixelOfThePicture) {
  const SceneFolder folder;
  folder.write("scene.toml", lit_scene);
  Listener listener;
  listener.hear();
  const Outcome outcome =
      run_portalens(folder.path(), {"render", "scene.toml", "-o", "a.exr", "--tile", "8",
                                    "--display-server", "127.0.0.1:" + listener.port()});
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  Faults faults;
  const auto picture = read_image(folder.path() / "a.exr", Location{}, faults);
  ASSERT_TRUE(picture);

  Reader stream(listener.heard());
  Image shown(21, 13, 3);
  int packets = 0, pixels = 0;
  for (; !stream.done() && !HasFailure(); ++packets) {
    const auto size = stream.number<std::uint32_t>();
    ASSERT_GT(size, 5u);
    Reader packet(stream.take(size - 4));
    const auto kind = packet.number<std::uint8_t>();
    packet.number<std::uint8_t>();
    EXPECT_EQ(packet.text(), "a.exr");
    if (packets == 0) {
      ASSERT_EQ(kind, 4);
      EXPECT_EQ(packet.number<std::int32_t>(), 21);
      EXPECT_EQ(packet.number<std::int32_t>(), 13);
    } else {
      ASSERT_EQ(kind, 6);
    }
    ASSERT_EQ(packet.number<std::int32_t>(), 3);
    for (const char* letter : {"R", "G", "B"}) EXPECT_EQ(packet.text(), letter);
    if (packets > 0) {
      const auto x0 = packet.number<std::int32_t>(), y0 = packet.number<std::int32_t>();
      const auto width = packet.number<std::int32_t>(), height = packet.number<std::int32_t>();
      ASSERT_LE(x0 + width, 21);
      ASSERT_LE(y0 + height, 13);
      for (const std::int64_t expected : {0, 1, 2, 3, 3, 3})
        EXPECT_EQ(packet.number<std::int64_t>(), expected);
      for (int y = y0; y < y0 + height; ++y)
        for (int i = 0; i < 3 * width; ++i) shown.at(x0, y)[i] = packet.number<float>();
      pixels += width * height;
    }
    EXPECT_TRUE(packet.done());
  }
  EXPECT_EQ(packets, 1 + 3 * 2);
  EXPECT_EQ(pixels, 21 * 13);
  EXPECT_EQ(shown.pixels, picture->pixels);
}

TEST(DisplayServer, ThatGoesAwayDoesNotHoldUpThePicture) {
  const SceneFolder folder;
  folder.write("scene.toml", lit_scene);
  Listener listener;
  listener.hear(1);
  const Outcome outcome = run_portalens(
      folder.path(), {"render", "scene.toml", "-o", "a.exr", "--tile", "1", "--width", "60",
                      "--height", "60", "--display-server", ":" + listener.port()});
  EXPECT_EQ(outcome.code, 0) << outcome.errors;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "a.exr"));
  EXPECT_NE(outcome.errors.find("display server"), std::string::npos);
}

TEST(DisplayServer, ThatIsNotThereIsToldBeforeTheWork) {
  const SceneFolder folder;
  folder.write("scene.toml", lit_scene);
  std::string port;
  {
    const Listener gone;
    port = gone.port();
  }
  const Outcome outcome =
      run_portalens(folder.path(), {"render", "scene.toml", "--width", "4000", "--height", "4000",
                                    "--display-server", "127.0.0.1:" + port});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.errors.find("127.0.0.1:" + port), std::string::npos) << outcome.errors;
  EXPECT_EQ(folder.size(), 1u);
}

TEST(DisplayAddress, IsReadInAnyOfItsForms) {
  const auto expect = [](const char* text, const char* host, const char* port) {
    const DisplayAddress address = display_address(text);
    EXPECT_EQ(address.host, host) << text;
    EXPECT_EQ(address.port, port) << text;
  };
  expect("", "127.0.0.1", "14158");
  expect(":99", "127.0.0.1", "99");
  expect("box", "box", "14158");
  expect("box:99", "box", "99");
  expect("[::1]:99", "::1", "99");
  expect("::1", "::1", "14158");
}

}  // namespace
}  // namespace portalens
