/// \file
/// Scenes with things in the planes of others, as people hang them.
#pragma once

#include <string>

namespace portalens::test {

/// A door on a wall, its exit on another.
inline const std::string door_on_a_wall = R"(
physics = { portal_gravity = "none" }
camera = { position = [0.5, 0.4, 4.0], look_at = [0.0, 0.0, 0.0], fov = 50 }
film = { width = 120, height = 90 }
shading = { ambient = [1, 1, 1] }
environment = { color = [0, 0, 1] }
material = [{ name = "entry wall", diffuse = [1, 0, 0] }, { name = "exit wall", diffuse = [0, 1, 0] }]
quad = [{ vertices = [[-3.0,-3.0,0.0],[3.0,-3.0,0.0],[3.0,3.0,0.0],[-3.0,3.0,0.0]], material = "entry wall" },
        { vertices = [[20.0,-1.0,7.0],[20.0,-1.0,1.0],[20.0,5.0,1.0],[20.0,5.0,7.0]], material = "exit wall" }]
portal = [{ name = "a", pair = "b", vertices = [[-1.0,-1.25,0.0],[1.0,-1.25,0.0],[1.0,1.25,0.0],[-1.0,1.25,0.0]] },
          { name = "b", pair = "a", vertices = [[20.0,0.75,5.0],[20.0,0.75,3.0],[20.0,3.25,3.0],[20.0,3.25,5.0]] }]
)";

/// The same on walls that no axis is parallel to.
inline const std::string door_on_an_oblique_wall = R"(
physics = { portal_gravity = "none" }
camera = { position = [2.9423370854455047, 0.12024570023522296, -0.4147341293443705], look_at = [0.1, 0.2, -3.3], fov = 50 }
film = { width = 120, height = 90 }
shading = { ambient = [1, 1, 1] }
environment = { color = [0, 0, 1] }
material = [{ name = "entry wall", diffuse = [1, 0, 0] }, { name = "exit wall", diffuse = [0, 1, 0] }]
quad = [{ vertices = [[-2.0743911316308,-3.2697505854103284,-2.189660375502157],[2.62703829195788,-2.167928092538256,-5.750916975245538],[2.2743911316308,3.6697505854103287,-4.410339624497842],[-2.4270382919578797,2.5679280925382564,-0.8490830247544618]], material = "entry wall" },
        { vertices = [[16.061858879583234,1.6531243990718665,3.9103621307066003],[20.47391139934703,2.6703266147579825,-0.026526515832592246],[24.538141120416768,1.7468756009281334,4.289637869293399],[20.12608860065297,0.7296733852420172,8.226526515832592]], material = "exit wall" }]
portal = [{ name = "a", pair = "b", vertices = [[-0.6101034121966383,-1.1998201400513004,-2.9857441814485393],[0.9570397289995883,-0.83254597576061,-4.172829714696333],[0.8101034121966383,1.5998201400513004,-3.6142558185514604],[-0.7570397289995884,1.2325459757606099,-2.4271702853036663]] },
          { name = "b", pair = "a", vertices = [[18.71794338814984,1.722851925266866,3.856947194188617],[20.188627561404438,2.0619193304955714,2.544650978675553],[21.88205661185016,1.677148074733134,4.343052805811382],[20.411372438595563,1.3380806695044287,5.655349021324446]] }]
)";

/// A room with two doors down to its floor, and a cluster that bends light.
inline const std::string room_with_doors = R"(
camera = { position = [1.5,1.6,2.4], look_at = [-0.8,1.2,-3], fov = 60 }
film = { width = 160, height = 100 }
light = [{ position = [0,3.5,0], intensity = [12,12,12] }]
material = [{ name = "m", diffuse = [0.7,0.7,0.7] }]
portal = [{ name = "a", pair = "b", vertices = [[-1.0,0.0,-3.0],[0.5,0.0,-3.0],[0.5,2.2,-3.0],[-1.0,2.2,-3.0]] },
          { name = "b", pair = "a", vertices = [[-3.0,0.0,1.5],[-3.0,0.0,0.0],[-3.0,2.2,0.0],[-3.0,2.2,1.5]] }]
mass = [{ center = [1.8,1.5,-1], mass = 60, core_radius = 0.3 }]
quad = [{ vertices = [[-3.0,0.0,3.0],[3.0,0.0,3.0],[3.0,0.0,-3.0],[-3.0,0.0,-3.0]], material = "m" },
        { vertices = [[-3.0,4.0,-3.0],[3.0,4.0,-3.0],[3.0,4.0,3.0],[-3.0,4.0,3.0]], material = "m" },
        { vertices = [[-3.0,0.0,-3.0],[3.0,0.0,-3.0],[3.0,4.0,-3.0],[-3.0,4.0,-3.0]], material = "m" },
        { vertices = [[3.0,0.0,-3.0],[3.0,0.0,3.0],[3.0,4.0,3.0],[3.0,4.0,-3.0]], material = "m" },
        { vertices = [[3.0,0.0,3.0],[-3.0,0.0,3.0],[-3.0,4.0,3.0],[3.0,4.0,3.0]], material = "m" },
        { vertices = [[-3.0,0.0,3.0],[-3.0,0.0,-3.0],[-3.0,4.0,-3.0],[-3.0,4.0,3.0]], material = "m" }]
)";

/// A mirror in the plane of a wall, listed before it.
inline const std::string mirror_on_a_wall = R"(
physics = { portal_gravity = "none" }
film = { width = 60, height = 45 }
environment = { color = [0, 0, 1] }
camera = { position = [0.3, 0.2, 3.0], look_at = [0.0, 0.0, 0.0], fov = 20 }
material = [{ name = "wall", diffuse = [1, 0, 0] },
            { name = "mirror", diffuse = [0, 0, 0], reflective = [1, 1, 1] }]
quad = [{ name = "mirror0", vertices = [[-2.0,-2.0,0.0],[2.0,-2.0,0.0],[2.0,2.0,0.0],[-2.0,2.0,0.0]], material = "mirror" },
        { vertices = [[-4.0,-4.0,0.0],[4.0,-4.0,0.0],[4.0,4.0,0.0],[-4.0,4.0,0.0]], material = "wall" }]
)";

/// A picture in the plane of an oblique wall, listed after it.
inline const std::string picture_on_a_wall = R"(
physics = { portal_gravity = "none" }
camera = { position = [20.73995341267205, -2.173650900445187, 3.1349768416465817], look_at = [20.3, 1.7, 4.1], fov = 50 }
film = { width = 120, height = 90 }
shading = { ambient = [1, 1, 1] }
material = [{ name = "wall", diffuse = [1, 0, 0] }, { name = "picture", diffuse = [0, 1, 0] }]
quad = [{ name = "the wall", vertices = [[16.061858879583234,1.6531243990718665,3.9103621307066003],[20.47391139934703,2.6703266147579825,-0.026526515832592246],[24.538141120416768,1.7468756009281334,4.289637869293399],[20.12608860065297,0.7296733852420172,8.226526515832592]], material = "wall" },
        { name = "the picture", vertices = [[18.88728629319441,1.6843747996906222,4.0367873769022],[20.35797046644901,2.0234422049193275,2.724491161389136],[21.71271370680559,1.7156252003093777,4.1632126230978],[20.24202953355099,1.3765577950806724,5.475508838610864]], material = "picture" }]
)";

/// Two pairs back to back in the same planes, but for the last bit of some coordinates.
inline const std::string pairs_back_to_back = R"(
film = { width = 160, height = 90 }
light = [{ position = [0, 3.5, 2], intensity = [20, 20, 19] }]
camera = { position = [3, 1.5, 4.5], look_at = [0, 1.0, -0.5], fov = 50 }
material = [{ name = "t", diffuse = [0.8,0.8,0.7] }]
quad = [{ vertices = [[-8,0,8],[8,0,8],[8,0,-8],[-8,0,-8]], material = "t" }]
portal = [{ name = "a", pair = "b", vertices = [[-2.25, 0.09999999999999987, -0.5], [-0.75, 0.09999999999999987, -0.5], [-0.75, 2.3, -0.5], [-2.25, 2.3, -0.5]] },
{ name = "b", pair = "a", vertices = [[0.75, 0.09999999999999987, -0.5], [2.25, 0.09999999999999987, -0.5], [2.25, 2.3, -0.5], [0.75, 2.3, -0.5]] },
{ name = "c", pair = "d", vertices = [[-0.75, 0.09999999999999987, -0.4999999999999999], [-2.25, 0.09999999999999987, -0.5000000000000001], [-2.25, 2.3, -0.5000000000000001], [-0.75, 2.3, -0.4999999999999999]] },
{ name = "d", pair = "c", vertices = [[2.25, 0.09999999999999987, -0.4999999999999999], [0.75, 0.09999999999999987, -0.5000000000000001], [0.75, 2.3, -0.5000000000000001], [2.25, 2.3, -0.4999999999999999]] }]
)";

/// A pair in one place, its fronts opposite: the way through leads nowhere else.
inline const std::string pair_in_one_place = R"(
camera = { position = [0.0, 2.0, 12.0], look_at = [0.0, 1.0, 0.0], fov = 40 }
film = { width = 96, height = 64 }
physics = { min_force = 0.05, portal_gravity = "none" }
mass = [{ center = [0.0, 1.0, 3.0], mass = 500 }]
portal = [{ name = "a", pair = "b", vertices = [[-3.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [-1.0, 2.0, 0.0], [-3.0, 2.0, 0.0]] },
          { name = "b", pair = "a", vertices = [[-1.0, 0.0, 0.0], [-3.0, 0.0, 0.0], [-3.0, 2.0, 0.0], [-1.0, 2.0, 0.0]] }]
)";

}  // namespace portalens::test
