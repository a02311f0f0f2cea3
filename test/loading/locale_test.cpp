// A host program may set any locale. Whatever the library reads and writes stays the same.
#include <gtest/gtest.h>

#include <clocale>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <locale>
#include <sstream>
#include <string>

#include "base/csv_writer.h"
#include "concave_distance/base/error.h"
#include "concave_distance/kinematics/scene_kinematics.h"
#include "concave_distance/loading/load_body_mesh.h"
#include "concave_distance/loading/load_scene.h"
#include "concave_distance/mesh/import/export_mesh.h"
#include "concave_distance/mesh/import/import_mesh.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "kinematics/frame_name.h"
#include "loading/query_poses.h"
#include "loading/set_effects.h"
#include "scene/name_pattern.h"
#include "scene/pair_parameters.h"
#include "scene/set_warning_distance.h"
#include "search/grid/body_grid.h"
#include "support/scene_fixture.h"

namespace concave_distance::locale_test {
namespace {

const std::string kUrdf = test::robot(
    "<link name='a'><inertial><mass value='1.5'/><origin xyz='0.25 0 0'/><inertia ixx='0.5' ixy='0' ixz='0'"
    " iyy='0.5' iyz='0' izz='0.5'/></inertial><visual><geometry><box size='1.5 1.5 1.5'/></geometry>"
    "<material name='m'><color rgba='0.25 0.5 0.75 1.0'/></material></visual>"
    "<collision><origin xyz='0.125 0 0' rpy='0.5 0 0'/><geometry><box size='1.5 1.25 1.125'/></geometry>"
    "</collision></link><link name='middle'/><link name='b'><collision><geometry><mesh filename='part.stl' "
    "scale='1.5 1.5 1.5'/></geometry></collision></link>"
    "<joint name='slide' type='prismatic'><origin xyz='2.5 0 0'/><parent link='a'/><child link='middle'/>"
    "<axis xyz='0.6 0.8 0'/><limit lower='0.5' upper='1.75' effort='1.5' velocity='1.5'/></joint>"
    "<joint name='turn' type='revolute'><origin xyz='0.5 0 0'/><parent link='middle'/><child link='b'/>"
    "<axis xyz='0 0 1'/><limit lower='-1.5' upper='1.5' effort='1.5' velocity='1.5'/>"
    "<mimic joint='slide' multiplier='0.5' offset='0.25'/></joint>");

const std::string kScene =
    "defaults: {cutoff: 7.25, least_prominence: 0.125, time_budget: 2.5e-1, chord_error: 0.0625,\n"
    "  max_edge_length: 99.5, warning_distance: 0.375, expert: {search_share: 0.25, cold: "
    "{crossover_probability: "
    "0.5}}}\n"
    "materials: {cork: {youngs_modulus: 1.25e7, poissons_ratio: 0.25}}\n"
    "robots: [{urdf: robot.urdf, srdf: robot.srdf}]\n"
    "bodies:\n"
    "  - {name: ball, sphere: {radius: 1.5}, pose: {xyz: [0.5, 1.25, 0.75], rpy: [0.5, 0, 0]},\n"
    "     colour: [0.25, 0.5, 0.75], material: cork}\n"
    "  - {name: part, mesh: part.obj, scale: 1.5}\n"
    "pairs: [{between: [ball, '[a-z]'], cutoff: 3.5}, {between: [ball, part]}]\n"
    "disable: [[ball, a]]\n";

// Before what ends a part of the list; no part ends so in the classic locale.
const std::string kBroken = "unexpected: ";

class LocaleTest : public test::SceneTest {
 protected:
  LocaleTest() {
    // 1200 vertices that no triangle uses: a count with a separator in some locales.
    std::string lines;
    for (int i = 0; i < 1200; ++i) lines += "v " + std::to_string(i) + ".5 0.25 0.125\n";
    exportMesh(makeBox({1.5, 1.25, 0.75}), folder.path("part.stl"));
    exportMesh(makeBox({1.5, 1.25, 0.75}), folder.path("part.ply"));
    exportMesh(makeBox({1.5, 1.25, 0.75}), folder.path("part.obj"));
    folder.write("ascii.stl", test::tetrahedronStl());
    folder.write("unused.obj", test::contentOf(folder.path("part.obj")) + lines);
    folder.write("robot.urdf", kUrdf);
    folder.write("robot.srdf", "<robot name='arm'><disable_collisions link1='a' link2='b'/></robot>");
    folder.write("poses.csv", "t,x,y,z,qx,qy,qz,qw\n0.25,1.5,0.125,-2.5e-1,0,0,0,1\n");
    folder.write("late.csv", "t,x,y,z,qx,qy,qz,qw\n0.5,0,0,0,0,0,0,1\n0.25,0,0,0,0,0,0,1\n");
    folder.write("comma.csv", "t,x,y,z,qx,qy,qz,qw\n0;5,0,0,0,0,0,0,1\n");
  }

  // Everything below adds to this text, numbers as their bits so that the test's own words do not depend on
  // a locale.
  std::string text;

  void add(const std::string& words) { text += words + "\n"; }
  void add(double number) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    text += std::to_string(bits) + "\n";
  }
  template <typename Matrix>
  void addAll(const Matrix& matrix) {
    for (Eigen::Index i = 0; i < matrix.size(); ++i) add(matrix.data()[i]);
  }
  void addRefusal(const std::function<void()>& act) {
    try {
      act();
      add("accepted");
    } catch (const Error& error) {
      add(error.what());
    }
  }

  void addScene(const Scene& scene) {
    for (const SceneBody& body : scene.bodies) {
      add(body.name + " " + body.frame + " " + body.source + " " + body.repair.summary());
      for (const Eigen::Vector3d& vertex : body.mesh->surface().vertices()) addAll(vertex);
      addAll(body.colour);
      if (body.inertia) add(body.inertia->mass), addAll(body.inertia->centre_in_body);
      for (const double value : {body.material.youngs_modulus, body.material.poissons_ratio}) add(value);
    }
    for (const ScenePair& pair : allPairs(scene)) {
      add(pair.name);
      for (const auto& parameter : pairParameters()) add(toText(parameter.get(pair.settings)));
    }
    for (const SceneProblem& problem : scene.problems) add(problem.where + ": " + problem.message);
    for (const auto* lines : {&scene.notes, &scene.warnings}) {
      for (const std::string& line : *lines) add(line);
    }
  }

  void addScenes() {
    Scene scene = load(kScene);
    addScene(scene);
    const SceneKinematics joints(scene);
    SceneState state = joints.startState();
    joints.evaluate(Eigen::VectorXd::Constant(1, 1.25), state);
    for (const auto& pose : state.world_from_body) {
      if (pose) addAll(pose->matrix());
    }
    SceneLoadOptions robot_alone = options;
    robot_alone.automatic_cutoff = true;
    addScene(loadRobotScene(kUrdf, folder.path("robot.urdf"), robot_alone));
    for (const std::string& name :
         setEffects(scene, "ball*", "{normal_force: {model: spring_dashpot, damping: 0.25}}"))
      add(name);
    for (const std::string& name : setWarningDistance(scene, "b?ll*", 0.25, 0.125)) add(name);
    addScene(scene);
    addRefusal([&] { setWarningDistance(scene, "ball*", -1234.5, 0.0); });
    addRefusal([&] { setEffects(scene, "ball*", "{normal_force: {damping: -1234.5}}"); });
    for (const std::string line :
         {"least_prominence: -1234.5", "cutoff: -0.5", "cutoff: 1,5", "largest_niche_count: 0",
          "time_budget: abc", "least_prominence: -1.5e-7", "warning_distance: 8000.5\n  cutoff: 1.5"}) {
      addRefusal([&] { (void)load("defaults:\n  " + line + "\n"); });
    }
    for (const std::string body : {"sphere: {radius: -1234.5}", "sphere: {radius: 1234.5}, chord_error: 1e-9",
                                   "mesh: part.stl, scale: 0", "mesh: part.stl, max_edge_length: 1e-6",
                                   "sphere: {radius: 1.5}, pose: {quaternion: [0.5, 0, 0, 1234.5]}",
                                   "sphere: {radius: 1.5}, pose: {xyz: [2.5e9, 0, 0]}"}) {
      addRefusal([&] { addScene(load("bodies: [{name: x, " + body + "}]\n")); });
    }
    addRefusal([&] { (void)load("bodies: [{name: x, frame: 'm\xC3\xA4rz\xE9', sphere: {radius: 1}}]\n"); });
  }

  void addMeshes() {
    for (const std::string file : {"part.stl", "part.ply", "part.obj", "ascii.stl", "unused.obj"}) {
      const LoadedBodyMesh loaded = loadBodyMesh(folder.path(file), 1.5);
      for (const Eigen::Vector3d& vertex : loaded.mesh->surface().vertices()) addAll(vertex);
      add(loaded.repair.summary());
    }
    for (const std::string file : {"out.obj", "out.ply"}) {
      exportMesh(makeSphere(1.5, 0.25), folder.path(file));
      add(test::contentOf(folder.path(file)));
    }
    const std::string path = folder.path("part.stl");
    addRefusal([&] { (void)loadBodyMesh(path, 0.0); });
    addRefusal([&] { (void)loadBodyMesh(path, std::numeric_limits<double>::infinity()); });
    LoadMeshOptions fine;
    fine.body.max_edge_length = 1.5e-5;
    addRefusal([&] { (void)loadBodyMesh(path, 1.5, fine); });
    fine.body.max_edge_length = -1234.5;
    addRefusal([&] { (void)gridOf(*loadBodyMesh(path, 1.5, fine).mesh).nodes().grid; });
    MeshImportLimits tight;
    tight.memory = 1'500'000;
    addRefusal([&] { (void)importMesh(path, Eigen::Vector3d::Ones(), tight); });
    addRefusal([&] { (void)repairMesh(TriangleSoup(), {1234.5}, "soup"); });
    addRefusal([&] { makeSphere(1234.5, 1.5e-7); });
    addRefusal([&] { makeSphere(-1234.5, 1.5); });
  }

  void addTables() {
    for (const QueryPose& pose : readQueryPoses(folder.path("poses.csv"))) {
      add(pose.time);
      addAll(pose.position);
    }
    addRefusal([&] { readPosePath(folder.path("late.csv")); });
    addRefusal([&] { readQueryPoses(folder.path("comma.csv")); });
    CsvFile file(folder.path("out.csv"), "x,y");
    file.cells() << 1234567.25 << 1234567;
    file.cells().endLine();
    file.finish();
    add(test::contentOf(folder.path("out.csv")));
    for (const std::string number : {"1.5", "-1.5e-3", "1,5", "1.234,5", "+0.5", "1e400", "0x10", "nan"}) {
      add(toText(parseParameter(findParameter(pairParameters(), "least_prominence")->info, number)));
    }
    for (const std::string pattern : {"?", "[a-z]", "[[:alpha:]]", "*\xC3\xA4"}) {
      for (const std::string name : {"\xC3\xA4", "B", "\xE4", "b"}) {
        add(detail::matchesPattern(pattern, name) ? "matches" : "does not match");
      }
    }
    for (const std::string frame : {"m\xC3\xA4rz", "a\x9F", "\xC2\x9F"}) add(tfFrameProblem(frame));
    TrackerParameters wrong;
    wrong.cutoff = -1234.5;
    addRefusal([&] { wrong.validate("x"); });
    const auto box = loadBodyMesh(folder.path("part.stl")).mesh;
    const PairSolution solution = solveOnce("x", box, box, TrackerParameters(),
                                            Eigen::Isometry3d(Eigen::Translation3d(3.5, 0.25, 0.125)));
    add(solution.distance);
  }

  std::string everything() {
    text.clear();
    for (const auto& add_part : {&LocaleTest::addScenes, &LocaleTest::addMeshes, &LocaleTest::addTables}) {
      try {
        (this->*add_part)();
      } catch (const Error& error) {
        add(kBroken + error.what());
      }
    }
    return text;
  }

  // A decimal comma and groups of three, made from what every Debian has when there is no such locale.
  std::string makeLocale(const std::string& name, const std::string& charset) const {
    const std::string target = folder.path("locales/" + name);
    folder.write("locales/source",
                 "comment_char %\nescape_char /\nLC_NUMERIC\ndecimal_point \",\"\nthousands_sep \".\"\n"
                 "grouping 3;3\nEND LC_NUMERIC\n");
    const std::string known = name.substr(0, name.find('.'));
    const bool installed = std::filesystem::exists("/usr/share/i18n/locales/" + known);
    const std::string source = installed ? known + " -f " + charset : folder.path("locales/source");
    const std::string command = "localedef -c --no-archive -i " + source + " " + target + " >" +
                                folder.path("localedef.log") + " 2>&1";
    return std::system(command.c_str()) >= 0 ? target : "";
  }
};

class CommaForCpp : public std::numpunct<char> {
 protected:
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

// Restores what the other tests of the program expect.
struct ClassicAfterwards {
  ~ClassicAfterwards() {
    std::locale::global(std::locale::classic());
    std::setlocale(LC_ALL, "C");
  }
};

std::string writtenByStream(double number) {
  std::ostringstream stream;
  stream << number;
  return stream.str();
}

std::string writtenByC(double number) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.1f", number);
  return digits;
}

TEST_F(LocaleTest, OfCppChangesNothing) {
  const ClassicAfterwards afterwards;
  const std::string expected = everything();
  ASSERT_GT(expected.size(), 10000U);
  ASSERT_EQ(expected.find(kBroken), std::string::npos) << expected.substr(expected.find(kBroken));
  std::locale::global(std::locale(std::locale::classic(), new CommaForCpp));
  ASSERT_EQ(writtenByStream(1234.5), "1.234,5") << "else the test shows nothing";
  EXPECT_EQ(everything(), expected);
}

TEST_F(LocaleTest, OfCAndCppChangesNothing) {
  const ClassicAfterwards afterwards;
  const std::string expected = everything();
  ::setenv("LOCPATH", folder.path("locales").c_str(), 1);
  for (const auto& [name, charset] : {std::pair<std::string, std::string>{"de_DE.UTF-8", "UTF-8"},
                                      {"pt_PT.UTF-8", "UTF-8"},
                                      {"pt_PT.ISO-8859-1", "ISO-8859-1"}}) {
    const std::string made = makeLocale(name, charset);
    ASSERT_NE(std::setlocale(LC_ALL, name.c_str()), nullptr)
        << made << ": " << test::contentOf(folder.path("localedef.log"));
    std::locale::global(std::locale(name));
    ASSERT_EQ(writtenByC(1.5), "1,5") << "else the test shows nothing";
    ASSERT_EQ(writtenByStream(1.5), "1,5");
    EXPECT_EQ(everything(), expected) << name;
  }
  ::unsetenv("LOCPATH");
}

}  // namespace
}  // namespace concave_distance::locale_test
