// The scenes, and the best settings of each engine: those that its authors recommend for such a scene, or better ones
// if we found any. Settings for all scenes are in the engine's own file.
//
//   hanging wire     all rows at once, in every engine that supports this; sweeps need about (N - 1) M/m, Eq. (6.12).
//                    k is so large that its effect is not visible.
//   swinging wire    spook's stiff solver has the tension's stiffness in M (chapter 12). Other solvers need steps below
//                    2/ω.
//   stacks           heavy on light: as the wire
//   tower            few and many sweeps, warm, and all rows at once. Our sweeps need a moderate k: with 1e6 N/m the
//                    tower sinks by 1e-3 of half a side, and 200 sweeps find this depth to 1e-5. All engines may use
//                    1/30 s here, and 1/12 s in piles. Our sweeps are interleaved, which takes 0.6 of the time.
//   sliding          Coulomb's cone, warm, to 1e-5 m/s: steady sliding needs one sweep a step, and stopping up to 50. A
//                    smaller tolerance concerns only the shares of the four corners: 1e-7 m/s would take all 50 sweeps
//                    in every step of 1/60 s, without moving the block. In other engines a box along the slip.
//   top              integration of rotations only; no rows
//   double pendulum  spook: d = 0, with which rods are of second order; and steps of order four
//   slide to roll    one sweep, cold: the three rows of a sphere on a plane are not coupled
//   structures       pyramids, walls and a grid of joints: soft steps, the default, and warm sweeps of the grid's rows.
//                    Dense pivoting is impractical there. All engines may use 1/60 s.
//   piles            sweeps, warm: direct solvers are impractical for thousands of rows. With few sweeps a warm start
//                    needs a small d, Eq. (10.12), and a margin that finds contacts before they close. With five
//                    sweeps, spheres jitter at such steps unless d is 10. Settings must work for five seeds.
#include "peers/engines/cases.hpp"

#include <map>

#include "scenes/registry.hpp"

namespace spook::peers {

namespace {

const std::vector<double> few = {1.0 / 60, 1.0 / 240};
const std::vector<double> many = {1.0 / 60, 1.0 / 120, 1.0 / 240, 1.0 / 480, 1.0 / 960, 1.0 / 1920};

std::vector<double> steps(std::initializer_list<double> per_second) {
  std::vector<double> h;
  for (const double each : per_second) h.push_back(1 / each);
  return h;
}

MakeJudge judge(std::unique_ptr<Judge> (*make)(const Problem&)) {
  return make;
}
template <class Number>
MakeJudge judge(std::unique_ptr<Judge> (*make)(const Problem&, Number), const auto& number) {
  return [make, number](const Problem& problem) { return make(problem, number); };
}

const std::vector<double> tall = steps({30, 60, 240});

/// The settings for wires and stacks: all rows at once, and sweeps in the engines that have them.
std::vector<TheirWay> all_at_once_or_sweeps(const std::vector<double>& h, const std::vector<int>& sweeps) {
  return {{"ODE", "step", h},       {"ODE", "quick", h, sweeps},
          {"Bullet", "dantzig", h}, {"Bullet", "sequential", h, sweeps},
          {"DART", "reduced", h},   {"MuJoCo", "newton", h}};
}

const std::vector<double> sixtieth = {1.0 / 60};

OurWay soft(int substeps) {
  return {.solver = "auto", .h = sixtieth, .soft_steps = substeps};
}

/// A structure that should stay as it is, for two seconds.
Case standing(const std::string& name, Structure which, int size, const std::vector<OurWay>& ours) {
  const bool joints = which == Structure::grid;
  std::vector<TheirWay> theirs = {{"ODE", "quick", sixtieth, {10, 50}},
                                  {"Bullet", "sequential", sixtieth, {10, 50}}};
  // MuJoCo's memory grows with the square of the rows, and its time faster: a wall of a hundred bricks takes minutes.
  if (size <= 10 && which == Structure::pyramid)
    theirs.insert(theirs.end(), {{"MuJoCo", "newton", sixtieth},
                                 {"MuJoCo", "pyramids", sixtieth},
                                 {"MuJoCo", "sweeps", sixtieth, {10, 50}}});
  return {.name = name,
          .scene = "",
          .set = {{}},
          .time = 2,
          .error = joints ? "largest gap of a joint over a link" : "farthest move over half a side",
          .judge = joints ? judge(holds_its_joints) : judge(stays_in_place),
          .ours = ours,
          .theirs = theirs,
          .build = [which, size](Settings<6> settings) { return structure(which, size, std::move(settings)); }};
}

Case stack(const std::string& name, const std::string& ratio) {
  return {.name = name,
          .scene = "stack",
          .set = {{"bodies=2", "ratio=" + ratio, "k=1e14"}},
          .time = 2,
          .error = "farthest move over a radius",
          .judge = judge(stays_in_place),
          .ours = {{"direct", few}},
          .theirs = all_at_once_or_sweeps(few, {50, 1000})};
}

Case pile(const std::string& name, const std::string& shape, const std::vector<OurWay>& ours) {
  const std::vector<double> h = steps({12, 15, 20, 30, 60, 120});
  return {.name = name,
          .scene = "pile",
          .set = {{"bodies=1000", "shape=" + shape, "k=1e6", "restitution=0"}},
          .time = 3,
          .error = "mean overlap over a size",
          .judge = judge(lies_without_overlap),
          .ours = ours,
          .theirs = {{"ODE", "quick", h, {5, 10, 30}},
                     {"ODE", "quick 0.4", h, {10, 30}},
                     {"Bullet", "sequential", h, {5, 10, 30}}}};
}

OurWay warm_sweeps(const std::vector<double>& h, const std::vector<int>& sweeps, double margin,
                   const std::string& set) {
  return {.solver = "gauss_seidel",
          .h = h,
          .sweeps = sweeps,
          .warm = true,
          .contact_margin = margin,
          .set = {set},
          .row_order = RowOrder::interleaved};
}

/// Returns the settings without those of MuJoCo, whose format nests the bodies of a chain: its reader refuses a hundred.
std::vector<TheirWay> without_mujoco(std::vector<TheirWay> theirs) {
  std::erase_if(theirs, [](const TheirWay& way) { return way.engine == "MuJoCo"; });
  return theirs;
}

}  // namespace

std::vector<Case> cases() {
  return {
      {.name = "wire 1000:1",
       .scene = "wire",
       .set = {{"links=100", "ratio=1000", "k=1e13"}},
       .time = 2,
       .error = "stretch over the length",
       .judge = judge<double>(keeps_its_length, 2.0),
       .ours = {{"direct", few}},
       .theirs = without_mujoco(all_at_once_or_sweeps(few, {50, 1000}))},
      {.name = "swinging wire 1000:1",
       .scene = "stiff_wire",
       .set = {{"links=10", "ratio=1000"}},
       .time = 5,
       .error = "farthest of the load over the length",
       .judge = judge(swings_as_rods),
       .ours = {{"geometric_stiffness", many}, {"direct", {many.begin() + 1, many.end()}}},
       .theirs = {{"ODE", "step", many},
                  {"Bullet", "dantzig", many},
                  {"Bullet", "sequential", many, {200}},
                  {"DART", "reduced", many}}},
      stack("stack 1000:1", "1000"),
      stack("stack 1e6:1", "1e6"),
      {.name = "two boxes 1e6:1",
       .scene = "tower",
       .set = {{"boxes=2", "ratio=1e6", "k=1e14"}},
       .time = 2,
       .error = "farthest move over half a side",
       .judge = judge(stays_in_place),
       .ours = {{"direct", few}},
       .theirs = all_at_once_or_sweeps(few, {50, 1000})},
      {.name = "tower of 20",
       .scene = "tower",
       .set = {{"boxes=20", "k=1e12"}},
       .time = 3,
       .error = "farthest move over half a side",
       .judge = judge(stays_in_place),
       .ours = {{"direct", tall}, warm_sweeps(tall, {5, 10, 50, 200}, 0.001, "k=1e6")},
       .theirs = all_at_once_or_sweeps(tall, {5, 10, 50, 200})},
      {.name = "sliding at four headings",
       .scene = "sliding_block",
       .set = {{"model=box", "heading=0"},
               {"model=box", "heading=20"},
               {"model=box", "heading=45"},
               {"model=box", "heading=70"}},
       .time = 1,
       .error = "error of the way over it",
       .judge = judge<double>(stops_by_coulomb, 3.0),
       .ours = {{.solver = "gauss_seidel",
                 .h = many,
                 .sweeps = {50},
                 .cone = true,
                 .warm = true,
                 .tolerance = 1e-5}},
       .theirs = all_at_once_or_sweeps(many, {50})},
      {.name = "asymmetric top",
       .scene = "top",
       .set = {{}},
       .time = 40,
       .error = "largest angle to the answer [rad]",
       .judge = judge<const Vec3&>(turns_by_euler, Vec3(0.01, 1, 0.01)),
       .ours = {{"auto", steps({2, 4, 8, 15, 30, 60, 120, 240, 480})}},
       .theirs = {{"ODE", "step", steps({60, 240, 960, 3840})},
                  {"Bullet", "sequential", steps({60, 240, 960, 3840}), {1}},
                  {"DART", "reduced", steps({60, 240, 960, 3840})}}},
      {.name = "bounces with e = 0.8",
       .scene = "bouncing_ball",
       .set = {{}},
       .time = 5,
       .error = "largest error of five peaks over the first height",
       .judge = judge<double>(bounces_to, 1.0),
       .ours = {{"gauss_seidel", many, {50}}},
       .theirs = {{"ODE", "step", many}, {"Bullet", "sequential", many, {10}}, {"DART", "reduced", many}}},
      {.name = "slide to roll",
       .scene = "slide_to_roll",
       .set = {{}},
       .time = 1,
       .error = "farthest along its way over the sliding part",
       .judge = judge<double>(slides_then_rolls, 3.0),
       .ours = {{"gauss_seidel", many, {1}}},
       .theirs = {{"ODE", "step", many}, {"Bullet", "sequential", many, {20}}, {"DART", "reduced", many}}},
      {.name = "double pendulum",
       .scene = "double_pendulum",
       .set = {{"d=0"}},
       .time = 2,
       .error = "farthest of the lower mass over both rods",
       .judge = judge(swings_as_rods),
       .ours = {{"direct", many},
                {.solver = "gauss_seidel", .h = steps({60, 120, 240, 480}), .integrator_order = 4}},
       .theirs = {{"ODE", "step", many},
                  {"Bullet", "dantzig", many},
                  {"Bullet", "sequential", many, {50}},
                  {"DART", "reduced", many}}},
      standing("pyramid of 10", Structure::pyramid, 10, {soft(2), soft(4), soft(8), {"auto", sixtieth}}),
      standing("pyramid of 20", Structure::pyramid, 20, {soft(4), soft(8), {"auto", sixtieth}}),
      standing("pyramid of 60", Structure::pyramid, 60, {soft(8), soft(16)}),
      standing("field of 25 pyramids", Structure::field, 5, {soft(2), soft(4), soft(8), {"auto", sixtieth}}),
      standing("wall 10 x 10", Structure::wall, 10, {soft(2), soft(4), soft(8), {"auto", sixtieth}}),
      standing("grid 40 x 40", Structure::grid, 40, {soft(2), soft(4), soft(8), {"auto", sixtieth}}),
      pile("1000 spheres", "sphere",
           {warm_sweeps(steps({12, 15, 20}), {5}, 0.01, "d=10"),
            warm_sweeps(steps({20, 30, 60}), {10, 20}, 0.006, "d=2")}),
      pile("1000 boxes", "box",
           {warm_sweeps(steps({12}), {7}, 0.006, "d=2"),
            warm_sweeps(steps({15, 20, 30, 60, 120}), {7, 20}, 0.003, "d=1")}),
  };
}

std::vector<Case> small_cases() {
  const std::vector<double> h = {1.0 / 480};
  const std::vector<TheirWay> each = {
      {"ODE", "step", h}, {"Bullet", "sequential", h, {50}}, {"DART", "reduced", h}, {"MuJoCo", "newton", h}};
  std::vector<Case> small;
  for (Case one : cases()) {
    const bool heap = one.scene == "pile",
               heavy = one.scene == "wire" || one.scene == "stiff_wire" || one.scene == "stack";
    if (heap || heavy || one.build || one.name == "two boxes 1e6:1") continue;
    one.time = std::min(one.time, 3.0);
    if (one.scene == "tower") one.set = {{"boxes=2", "k=1e12"}};
    one.theirs = each;
    if (one.scene == "bouncing_ball") one.theirs.pop_back();  // MuJoCo has no restitution
    for (OurWay& way : one.ours) way.h = h;
    one.ours.resize(1);
    small.push_back(one);
  }
  return small;
}

std::unique_ptr<Scene> our_scene(const Case& one, std::size_t set, const OurWay& way, double h, int sweeps) {
  const SceneDescription& description = find_scene(one.scene);
  Parameters parameters(description.parameters);
  std::map<std::string, std::string> values;
  for (const auto& texts : {way.set, one.set[set]})  // the setting's own values have priority
    for (const std::string& text : texts) {
      const std::size_t equals = text.find('=');
      values.emplace(text.substr(0, equals), text.substr(equals + 1));
    }
  for (const auto& [name, value] : values) parameters.set(name, value);
  Method method{.h = h, .solver = way.solver, .row_order = way.row_order, .warm_start = way.warm};
  if (sweeps > 0) method.solver_limits = {.max_sweeps = sweeps, .tolerance = way.tolerance};
  method.friction_model = way.cone ? FrictionModel::cone : FrictionModel::box;
  if (way.contact_margin >= 0) method.contact_margin = way.contact_margin;
  if (way.integrator_order != 2) method.integrator_order = way.integrator_order;
  return description.build(parameters, method);
}

World<6> our_structure(const Case& one, const OurWay& way, int sweeps) {
  const NamedSolver<6>& named = find_solver<6>(way.solver);
  Settings<6> settings{.friction = 0.6,
                       .solver = named.make_on_cones ? named.make_on_cones() : named.make_on_box(),
                       .warm_start = way.warm};
  if (sweeps > 0) settings.solver_limits = {.max_sweeps = sweeps, .tolerance = way.tolerance};
  if (way.soft_steps > 0) settings.soft_steps = SoftSteps{.substeps = way.soft_steps};
  return one.build(std::move(settings));
}

}  // namespace spook::peers
