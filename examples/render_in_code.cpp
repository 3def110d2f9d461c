// Builds a scene in code, checks it, and writes its picture: render_in_code [FILE.png|FILE.exr]
#include <portalens/portalens.h>

#include <cstdio>

using namespace portalens::api;

namespace {

// The keys are those of scene files; docs/scene-format.md lists them.
Scene hole_between_doors() {
  Scene scene;
  scene.set("camera", {{"position", {0, 1.4, 7}}, {"look_at", {0, 1.2, 0}}});
  scene.set("film", {{"width", 96}, {"height", 54}});
  scene.set("environment", {{"color", {0.2, 0.3, 0.5}}});
  scene.add("light", {{"position", {-4, 8, 6}}, {"intensity", {250, 250, 230}}});

  const Entries checker = {{"checker", {{0.8, 0.8, 0.7}, {0.1, 0.1, 0.3}}}, {"size", 1}};
  scene.add("material", {{"name", "tiles"}, {"diffuse", checker}});
  scene.add("quad", {{"vertices", {{-12, 0, 8}, {12, 0, 8}, {12, 0, -12}, {-12, 0, -12}}},
                     {"material", "tiles"}});
  scene.add("mass", {{"name", "hole"}, {"center", {0, 1.4, 0}}, {"mass", 40}});

  for (const double x : {-2.2, 2.2})  // a door on each side of the hole
    scene.add("portal",
              {{"name", x < 0 ? "left" : "right"},
               {"pair", x < 0 ? "right" : "left"},
               {"vertices",
                {{x - 0.6, 0.1, -1}, {x + 0.6, 0.1, -1}, {x + 0.6, 2.4, -1}, {x - 0.6, 2.4, -1}}}});
  return scene;
}

}  // namespace

int main(int argc, char** argv) {
  const char* file = argc > 1 ? argv[1] : "hole.png";
  try {
    const Scene scene = hole_between_doors();
    const Report report = check(scene);
    for (const Fault& fault : report.faults) std::printf("%s\n", to_string(fault).c_str());
    if (!report.sound()) return 1;
    for (const MassSummary& mass : report.summary.masses)
      std::printf("%s swallows light within %.4f\n", mass.name.c_str(), mass.horizon_radius);

    const Rendering rendering = render(compile(scene));
    write_picture(file, rendering.picture, {{"Comment", "built in code"}});
    std::printf("%s: %d x %d, %llu photons swallowed\n", file, rendering.picture.width,
                rendering.picture.height,
                static_cast<unsigned long long>(rendering.ended(Fate::absorbed)));
  } catch (const Error& error) {  // all the faults there are
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
