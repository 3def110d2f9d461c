// Sends a fan of photons past a mass, and prints by how much each is bent, beside what holds far
// from it: fan_of_rays [SECTION.KEY=VALUE ...]
#include <portalens/portalens.h>

#include <cmath>
#include <cstdio>

using namespace portalens::api;

int main(int argc, char** argv) {
  try {
    Scene scene = Scene::from_text(R"(
      [physics]
      G = 1.0
      c = 1.0
      min_force = 0.0       # the pull reaches everywhere
      tolerance = 1e-8
      max_length = 4000.0
      [[mass]]
      name = "star"
      center = [0, 0, 0]
      mass = 0.01)");
    for (int i = 1; i < argc; ++i) scene.assign(argv[i]);
    const World world = compile(scene);

    const Vec3 eye{0, 0, 1000};
    const std::vector<Ray> rays = fan({eye, {0, 0, -1}}, {0, 1, 0}, 0.4, 9);
    const std::vector<Trace> traces = trace(world, rays);
    std::printf("passes at   fate      bent by   2 G M / (c^2 b)\n");
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const double b = eye.z * std::fabs(rays[i].direction.x);
      std::printf("%9.4f   %-8s  %.6f   %.6f\n", b, to_string(traces[i].fate), traces[i].turning,
                  b > 0 ? 2 * 0.01 / b : 0.0);
    }

    const Field here = field_parts(world, {3, 0, 0});
    std::printf("at (3, 0, 0) light is pulled by (%g, %g, %g):", here.acceleration.x,
                here.acceleration.y, here.acceleration.z);
    for (const FieldPart& part : here.parts) std::printf(" %s", part.mass.c_str());
    std::printf("\n");
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
