#include "support/gyoto.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <sstream>
#include <string_view>

#include "core/error.h"
#include "io/files.h"

namespace portalens::benchmarks {
namespace {

constexpr double theta = 1.5;  ///< colatitude of the screen

std::string xml(const GyotoScene& scene) {
  return fmt::format(R"(<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<Scenery>
  <Metric kind="KerrBL"><Spin> 0 </Spin></Metric>
  <Screen>
    <Position> 1000 {} {} 0 </Position>
    <FieldOfView> {} </FieldOfView>
    <Rectilinear/>
    <Resolution> {} </Resolution>
  </Screen>
  <Astrobj kind="FixedStar">
    <Position> 0 0 0 </Position>
    <Radius> 0.1 </Radius>
    <RMax> {} </RMax>
    <OpticallyThick/>
  </Astrobj>
  <Quantities> ImpactCoords </Quantities>
  <Integrator>{}</Integrator>
  <RelTol> {} </RelTol>
  <AbsTol> {} </AbsTol>
</Scenery>
)",
                     scene.distance, theta, scene.view, scene.side, scene.far, scene.integrator,
                     scene.tolerance, scene.tolerance);
}

/// Runs a program with its output thrown away; the processor time that it took, seconds.
double run_quietly(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
  pid_t process = 0;
  const int failure =
      posix_spawn(&process, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throw WorkError(words[0] + ": " + std::strerror(failure));
  int status = 0;
  rusage usage{};
  while (wait4(process, &status, 0, &usage) < 0)
    if (errno != EINTR) throw WorkError(words[0] + ": " + std::strerror(errno));
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw WorkError(words[0] + " failed");
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// The last array of doubles in a FITS file (Pence et al., A&A 524, A42, 2010): blocks of 2880
/// bytes, headers of 80 characters a card, numbers with the highest byte first.
std::vector<double> last_array(const std::string& bytes) {
  constexpr std::size_t block = 2880, card = 80;
  std::vector<double> array;
  std::size_t at = 0;
  const auto round_up = [](std::size_t size) { return (size + block - 1) / block * block; };
  while (at + block <= bytes.size()) {
    std::size_t count = 1;
    std::string dimensions;
    for (bool ended = false; !ended; at += card) {
      if (at + card > bytes.size()) throw WorkError("a FITS header has no end");
      const std::string line = bytes.substr(at, card);
      ended = line.rfind("END ", 0) == 0;
      if (line.rfind("BITPIX  =", 0) == 0 && std::atoi(line.c_str() + 10) != -64)
        throw WorkError("a FITS array is not of doubles");
      if (line.rfind("NAXIS", 0) == 0 && line[5] != ' ')
        count *= static_cast<std::size_t>(std::max(0, std::atoi(line.c_str() + 10)));
    }
    at = round_up(at);
    if (count > bytes.size() / 8 || at + 8 * count > bytes.size())
      throw WorkError("a FITS file is too short");
    array.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      std::uint64_t bits = 0;
      for (std::size_t k = 0; k < 8; ++k)
        bits = bits << 8 | static_cast<unsigned char>(bytes[at + 8 * i + k]);
      array[i] = std::bit_cast<double>(bits);
    }
    at += round_up(8 * count);
  }
  return array;
}

/// Unit vectors at a place on the sphere: outwards, along growing colatitude, and longitude.
struct Axes {
  Vec3d out, south, east;

  Axes(double colatitude, double longitude)
      : out{std::sin(colatitude) * std::cos(longitude), std::sin(colatitude) * std::sin(longitude),
            std::cos(colatitude)},
        south{std::cos(colatitude) * std::cos(longitude),
              std::cos(colatitude) * std::sin(longitude), -std::sin(colatitude)},
        east{-std::sin(longitude), std::cos(longitude), 0} {}
};

/// Where the photon of a pixel, counted from the lower left, starts: the way round the hole that it
/// takes (a unit vector), and its impact parameter. GYOTO's screen is numbered against the
/// longitude, and a photon's angle is what an observer at rest there sees.
struct Start {
  Vec3d around;
  double impact;

  Start(const GyotoScene& scene, int i, int j) {
    const double scale = 2.0 * std::tan(0.5 * scene.view) / scene.side;
    const double middle = 0.5 * (scene.side - 1);
    const double x = (middle - i) * scale, y = (j - middle) * scale;
    const Axes axes(theta, 0.0);
    around = normalize(axes.south * -y - axes.east * x);
    impact = scene.distance * std::sin(std::atan(std::hypot(x, y))) /
             std::sqrt(1.0 - 2.0 / scene.distance);
  }
};

/// The direction in which a photon leaves for infinity, from (t, r, colatitude, longitude) and
/// their derivatives. It was followed backwards.
Vec3d direction_at_infinity(const double* state) {
  const double r = state[1];
  const Axes axes(state[2], state[3]);
  const Vec3d turning = axes.south * -state[6] - axes.east * (std::sin(state[2]) * state[7]);
  const double impact = r * r * length(turning) / ((1.0 - 2.0 / r) * std::fabs(state[4]));
  const double sweep = schwarzschild_sweep(impact, r);
  return axes.out * std::cos(sweep) + normalize(turning) * std::sin(sweep);
}

}  // namespace

double schwarzschild_half_sweep(double b) { return schwarzschild_sweep(b, 0.0); }

double schwarzschild_sweep(double b, double r) {
  // With u = 1/r, du/dψ = sqrt(1/b² - u² + 2 u³) = sqrt(2 (u - u1) (u - u2) (u - u3)): the roots by
  // Viète, the integral by Legendre's first (Darwin, Proc. R. Soc. A 249, 1959).
  const double angle = std::acos(1.0 - 54.0 / (b * b)) / 3.0;
  const auto root = [&](int k) {
    return 1.0 / 6.0 + std::cos(angle - 2.0 * std::numbers::pi * k / 3.0) / 3.0;
  };
  const double u3 = root(0), u2 = root(1), u1 = root(2);
  const double modulus = std::sqrt((u2 - u1) / (u3 - u1));
  const auto amplitude = [&](double u) {
    return std::asin(std::sqrt(std::min(1.0, (u - u1) / (u2 - u1))));
  };
  const double from = r > 0.0 ? std::min(1.0 / r, u2) : u2;
  return 2.0 / std::sqrt(2.0 * (u3 - u1)) *
         (std::ellint_1(modulus, amplitude(from)) - std::ellint_1(modulus, amplitude(0.0)));
}

std::optional<std::string> find_program(const std::string& name) {
  if (name.find('/') != std::string::npos)
    return access(name.c_str(), X_OK) == 0 ? std::optional(name) : std::nullopt;
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const std::string file = folder + "/" + name; access(file.c_str(), X_OK) == 0) return file;
  return std::nullopt;
}

GyotoRun run_gyoto(const std::string& program, const GyotoScene& scene,
                   const std::filesystem::path& folder) {
  const std::string input = (folder / "gyoto.xml").string();
  const std::string output = (folder / "gyoto.fits").string();
  replace_file(input, xml(scene));
  std::filesystem::remove(output);
  GyotoRun run;
  run.processor_seconds = run_quietly({program, "--silent", "-T1", input, output});
  Faults faults;
  const auto bytes = read_file(output, std::uint64_t{1} << 32, {}, faults);
  faults.raise();
  const std::vector<double> states = last_array(*bytes);
  const auto pixels = static_cast<std::size_t>(scene.side) * scene.side;
  if (states.size() != 16 * pixels) throw WorkError("GYOTO gave no impact coordinates");
  for (std::size_t k = 0; k < pixels; ++k) {
    const Start start(scene, static_cast<int>(k) % scene.side, static_cast<int>(k) / scene.side);
    const double* final_state = states.data() + 16 * k + 8;
    const bool escaped = std::fabs(final_state[1]) < 1e300;
    const bool should_escape = start.impact * start.impact > 27.0;
    if (!escaped) ++run.captured;
    if (escaped != should_escape) ++run.mismatched;
    if (!escaped || !should_escape || start.impact < scene.judged_from * std::sqrt(27.0)) continue;
    const double sweep = 2.0 * schwarzschild_half_sweep(start.impact) -
                         schwarzschild_sweep(start.impact, scene.distance);
    const Vec3d right = Axes(theta, 0.0).out * std::cos(sweep) + start.around * std::sin(sweep);
    run.errors.push_back(length(direction_at_infinity(final_state) - right));
  }
  return run;
}

}  // namespace portalens::benchmarks
