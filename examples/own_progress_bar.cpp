// Renders a scene file with a progress bar of its own, and stops after so many seconds:
// own_progress_bar SCENE [SECONDS]
#include <portalens/portalens.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

using namespace portalens::api;

namespace {

void draw_bar(const Progress& progress) {
  constexpr std::size_t width = 40;
  const std::size_t full = width * progress.done / progress.total;
  const std::string bar = std::string(full, '#') + std::string(width - full, '.');
  std::printf("\r[%s] %3zu %%", bar.c_str(), 100 * progress.done / progress.total);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::fprintf(stderr, "own_progress_bar SCENE [SECONDS]\n"), 2;
  using Clock = std::chrono::steady_clock;
  try {
    const World world = compile(Scene::from_file(argv[1]));
    for (const std::string& warning : world.summary().warnings)
      std::printf("warning: %s\n", warning.c_str());

    const Clock::time_point start = Clock::now();
    const auto most = std::chrono::duration<double>(argc > 2 ? std::atof(argv[2]) : 1e9);
    RenderOptions options;
    options.progress = draw_bar;                                      // one thread at a time
    options.cancelled = [=] { return Clock::now() - start > most; };  // all threads at once
    const Rendering rendering = render(world, options);
    std::printf("\n%s after %.2f s: %llu photons\n", rendering.complete ? "done" : "stopped",
                rendering.seconds, static_cast<unsigned long long>(rendering.photons));
    write_picture("own_progress_bar.png", rendering.picture);
  } catch (const Error& error) {
    for (const Fault& fault : error.faults())
      std::fprintf(stderr, "%s\n", to_string(fault).c_str());
    return error.cause() == Cause::asked ? 2 : 1;
  }
}
