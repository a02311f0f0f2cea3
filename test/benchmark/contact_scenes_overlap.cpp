#include <cmath>

#include "benchmark/contact_scenes.h"
#include "benchmark/support/contact_stage.h"
#include "benchmark/support/shapes.h"
#include "concave_distance/mesh/surface/primitives.h"

namespace concave_distance::benchmark {
namespace {

using test::at;

// A peg of 20.1 mm in a hole of 20.0 mm of a ring 20 mm thick and 60 mm wide.
constexpr int kCorners = 96;
constexpr double kHoleRadius = 0.010;
constexpr double kRingRadius = 0.030;
constexpr double kThickness = 0.020;
constexpr double kPegRadius = 0.01005;
constexpr double kPegLength = 0.040;
constexpr double kInterference = kPegRadius - kHoleRadius;  // radial

SurfaceMesh holedPlate() {
  return makeTube(kRingRadius, kHoleRadius, kThickness, kCorners);
}
SurfaceMesh pressedPeg() {
  return makePolygonPrism(kPegRadius, kPegLength, kCorners);
}

EffectSettings regionsAlone() {
  EffectSettings effects;
  effects.interference = true;
  return effects;
}

double deepest(const PairContacts& contacts) {
  return contacts.regions.empty() ? 0.0 : contacts.regions.front().overlap.depth;
}

void pressFitDepth(SceneReport& report) {
  PairProbe probe(holedPlate(), pressedPeg(), regionsAlone());
  report.equals({"depth; 20.1 mm peg centred in 20.0 mm hole", "mm", 1e3 * deepest(probe.at(at(0, 0, 0)))},
                1e3 * kInterference, 1e-2 * 1e3 * kInterference, "r_peg - r_hole (0.1 mm of diameter)");
}

void pressFitShifted(SceneReport& report) {
  PairProbe probe(holedPlate(), pressedPeg(), regionsAlone());
  const double shift = 0.15e-3;
  report.equals({"depth; peg shifted by 0.15 mm", "mm", 1e3 * deepest(probe.at(at(shift, 0, 0)))},
                1e3 * (shift + kInterference), 1e-2 * 1e3 * (shift + kInterference),
                "shift + r_peg - r_hole");
  double before = 0.0;
  double largest_error = 0.0;
  int shallower = 0;
  for (int i = 0; i <= 24; ++i) {
    const double shift_now = 0.06e-3 + 0.01e-3 * i;
    const double depth = deepest(probe.at(at(shift_now, 0, 0)));
    if (i > 0 && !(depth > before)) ++shallower;
    largest_error = std::max(largest_error, std::abs(depth - shift_now - kInterference));
    before = depth;
  }
  report.atMost(
      {"times shallower though pushed deeper (0.06 to 0.3 mm)", "1", static_cast<double>(shallower)}, 0.0,
      "monotone");
  report.atMost({"largest error of the depth over these shifts", "mm", 1e3 * largest_error}, 3.5e-3,
                "1 % of the deepest");
}

/// Of a solid peg in a ring of the same material, pascal (Lame, plane stress).
double lamePressure(const Material& material) {
  const double ratio = kHoleRadius / kRingRadius;
  return 0.5 * material.youngs_modulus * kInterference / kHoleRadius * (1.0 - ratio * ratio);
}

/// The friction that resists pushing the peg along its axis: the pressure integrated, whatever normal a
/// region is given. The sliding speed leaves the dynamic coefficient alone.
void pressFitForce(SceneReport& report) {
  const Material material;
  const double pressure = lamePressure(material);
  const double expected = material.dynamic_friction * pressure * 2.0 * kPi * kHoleRadius * kThickness;
  for (const NormalForceModel model :
       {NormalForceModel::HuntCrossley, NormalForceModel::QuasiStatic, NormalForceModel::ElasticFoundation}) {
    EffectSettings effects = effectsOf(model, FrictionModel::RegularisedCoulomb);
    std::string what = "push-out force; " + std::string(toString(model));
    if (model == NormalForceModel::ElasticFoundation) {
      effects.normal_force->foundation_stiffness = pressure / kInterference;
      what += " of Lame's stiffness";
    }
    PairProbe probe(holedPlate(), pressedPeg(), effects, material);
    RelativeTwist sliding;
    sliding.linear.z() = 0.1;
    const double found = -probe.at(at(0, 0, 0), sliding).on_b_in_a.force.z();
    report.equals({what, "N", found}, expected, 0.1 * expected,
                  "mu p A with Lame's p = E d (1 - r^2/R^2) / (2 r)");
  }
}

/// What a bed of springs of Lame's stiffness holds where it is pressed in by `depth` all around, joules.
double strainEnergy(double depth) {
  const double area = 2.0 * kPi * kHoleRadius * kThickness;
  return 0.5 * lamePressure(Material()) / kInterference * depth * depth * area;
}

/// Largest kinetic energy of a peg of 0.1 kg that is let go; ends when it has left the plate.
double letGo(SceneRun& run) {
  double largest = 0.0;
  while (run.step()) {
    largest = std::max(largest, run.simulation().energy().kinetic);
    if (run.body(1).centre.norm() > 0.1) run.giveUp("the peg has left");
  }
  return largest;
}

/// Under its weight alone friction holds it: 1 N against some kN.
void pressFitReleased(SceneReport& report, NormalForceModel model) {
  ContactStage stage;
  stage.effects = effectsOf(model, FrictionModel::Bristle);
  stage.addFixed("plate", holedPlate(), at(0, 0, 0));
  stage.addFree("peg", pressedPeg(), 0.1, at(0, 0, 0));
  stage.letMeet("plate", "peg");
  SceneRun run(stage.simulation(), 0.5, report);
  const double kinetic = letGo(run);
  report.atMost({"largest kinetic energy; " + std::string(toString(model)), "J", kinetic},
                1e-2 * strainEnergy(kInterference), "at rest; 1 % of Lame's strain energy", run.figures());
  report.realTimeFactor(run.figures(), 1.0);
}

/// Begun 0.15 mm off its place, without friction or weight.
void pressFitSwings(SceneReport& report) {
  const double shift = 0.15e-3;
  ContactStage stage;
  stage.effects = effectsOf(NormalForceModel::HuntCrossley);
  stage.addFixed("plate", holedPlate(), at(0, 0, 0));
  stage.addFree("peg", pressedPeg(), 0.1, at(shift, 0, 0));
  stage.letMeet("plate", "peg");
  stage.settings.gravity.setZero();
  SceneRun run(stage.simulation(), 0.1, report);
  const double kinetic = letGo(run);
  report.atMost({"largest kinetic energy; let go 0.15 mm off", "J", kinetic},
                strainEnergy(kInterference + shift), "Lame's stiffness pressed in by 0.2 mm all around",
                run.figures());
  report.realTimeFactor(run.figures(), kNotComputed);
}

constexpr double kLongPeg = 0.060;

SurfaceMesh solidPlate() {
  return makeBox({0.2, 0.2, kThickness});
}

void pegThroughPlate(SceneReport& report) {
  struct Turn {
    const char* what;
    Eigen::Vector3d axis;
  };
  const SurfaceMesh peg = makePolygonPrism(kHoleRadius, kLongPeg, kCorners);
  for (const Turn& turn : {Turn{"flips of the normal; 1000 poses tilted by 1 mrad each", {1.0, 0.0, 0.0}},
                           Turn{"flips of the normal; 1000 poses turned by 1 mrad each", {0.0, 0.0, 1.0}}}) {
    PairProbe probe(solidPlate(), peg, regionsAlone());
    Eigen::Vector3d before = Eigen::Vector3d::Zero();
    int flips = 0;
    for (int i = 0; i < 1000; ++i) {
      const Eigen::Isometry3d pose(Eigen::AngleAxisd(1e-3 * i, turn.axis));
      const PairContacts& contacts = probe.at(pose);
      if (contacts.regions.empty()) continue;
      const Eigen::Vector3d normal = contacts.regions.front().overlap.normal_in_a;
      if (normal.dot(before) < 0.0) ++flips;
      before = normal;
    }
    report.atMost({turn.what, "1", static_cast<double>(flips)}, 0.0, "continuous along the motion");
  }
}

/// A peg of 60 mm, its middle 5 mm above the plate's, tilted a little: 35 mm to go upwards, 45 mm downwards.
SceneRun leavePlate(NormalForceModel model, double tilt, const SceneReport& report) {
  ContactStage stage;
  stage.effects = effectsOf(model);
  stage.addFixed("plate", solidPlate(), at(0, 0, 0));
  stage.addFree("peg", makePolygonPrism(kHoleRadius, kLongPeg, kCorners), 0.15,
                at(0, 0, 0.005) * Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitX()));
  stage.letMeet("plate", "peg");
  stage.settings.gravity.setZero();
  SceneRun run(stage.simulation(), 0.1, report);
  while (run.step()) {
    if (std::abs(run.body(1).centre.z()) > 0.06) run.stop("the peg has left");
  }
  return run;
}

void pegLeavesPlate(SceneReport& report, NormalForceModel model) {
  int by_the_longer_way = 0;
  double fastest = 0.0;
  RunFigures figures;
  for (int i = 0; i < 10; ++i) {
    const SceneRun run = leavePlate(model, 0.003 * i, report);
    if (run.body(1).centre.z() < 0.0) ++by_the_longer_way;
    fastest = std::max(fastest, run.body(1).velocity.norm());
    figures = run.figures();
  }
  const std::string with = "; " + std::string(toString(model));
  report.atMost({"leaves by the longer way; of 10 tilts" + with, "1", static_cast<double>(by_the_longer_way)},
                0.0, "35 mm up or 45 mm down", figures);
  report.note({"largest speed at the end" + with, "m/s", fastest}, figures);
}

}  // namespace

ContactScenes overlapScenes() {
  ContactScenes scenes = {{"press_fit_depth", "a peg of 20.1 mm in a hole of 20.0 mm", pressFitDepth},
                          {"press_fit_shifted", "the same, shifted sideways", pressFitShifted},
                          {"press_fit_force", "the same, against Lame's pressure", pressFitForce}};
  for (const NormalForceModel model : {NormalForceModel::HuntCrossley, NormalForceModel::SpringDashpot,
                                       NormalForceModel::ElasticFoundation}) {
    scenes.push_back({"press_fit_released_" + std::string(toString(model)), "the same, let go",
                      [model](SceneReport& report) { pressFitReleased(report, model); }});
  }
  scenes.push_back({"press_fit_swings", "the same, let go off its place", pressFitSwings});
  scenes.push_back(
      {"peg_through_plate", "through a plate without a hole, turned bit by bit", pegThroughPlate});
  for (const NormalForceModel model : {NormalForceModel::HuntCrossley, NormalForceModel::SpringDashpot}) {
    scenes.push_back({"peg_leaves_plate_" + std::string(toString(model)), "the same, let go",
                      [model](SceneReport& report) { pegLeavesPlate(report, model); }});
  }
  return scenes;
}

}  // namespace concave_distance::benchmark
