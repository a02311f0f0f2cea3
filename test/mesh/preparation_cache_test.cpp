#include "concave_distance/mesh/preparation_cache.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>

#include "concave_distance/mesh/import/export_mesh.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "search/grid/body_grid.h"
#include "support/body_bytes.h"
#include "support/body_pairs.h"
#include "support/scene_fixture.h"

namespace concave_distance::preparation_cache_test {
namespace {

using test::mentions;

std::vector<std::string> filesIn(const std::string& folder) {
  std::vector<std::string> files;
  if (!std::filesystem::exists(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

class PreparationCacheTest : public test::SceneTest {
 protected:
  PreparationCacheTest() {
    exportMesh(test::makeComb(4), folder.path("comb.stl"));
    exportMesh(makeSphere(0.4, 2e-3), folder.path("ball.ply"));  // fine enough to be thinned
    options.cache = std::make_shared<PreparationCache>(cache_folder());
  }
  std::string cache_folder() const { return folder.path("cache"); }
  /// The ball's grid is thinned, the comb's has levels.
  Scene loadBoth(const std::string& more = "") {
    return load(more +
                "bodies:\n  - {name: comb, mesh: comb.stl, max_edge_length: 0.025}\n"
                "  - {name: ball, mesh: ball.ply}\n");
  }
  static std::map<std::string, test::Bytes> bytesOf(const Scene& scene) {
    std::map<std::string, test::Bytes> all;
    for (const SceneBody& body : scene.bodies) {
      for (auto& [part, bytes] : test::bytesOf(*body.mesh)) all[body.name + ": " + part] = bytes;
      const std::string summary = body.repair.summary();
      all[body.name + ": repair"] = test::Bytes(summary.begin(), summary.end());
    }
    return all;
  }
  static void expectSame(const std::map<std::string, test::Bytes>& found,
                         const std::map<std::string, test::Bytes>& expected, const std::string& where) {
    ASSERT_EQ(found.size(), expected.size()) << where;
    for (const auto& [part, bytes] : expected) EXPECT_TRUE(found.at(part) == bytes) << where << ", " << part;
  }
};

TEST_F(PreparationCacheTest, AHitIsAMissBitForBit) {
  options.cache = nullptr;
  const Scene scene = loadBoth();
  EXPECT_FALSE(gridOf(*scene.bodies[0].mesh).nodes().levels.levels.empty());
  EXPECT_TRUE(gridOf(*scene.bodies[1].mesh).nodes().thinned());
  const auto without = bytesOf(scene);
  EXPECT_TRUE(filesIn(cache_folder()).empty());
  options.cache = std::make_shared<PreparationCache>(cache_folder());
  expectSame(bytesOf(loadBoth()), without, "stored");
  const std::vector<std::string> files = filesIn(cache_folder());
  // Each body has nine: surface, topology, trees, nodes, metric, contacts, facets, adjacency, cones.
  EXPECT_EQ(files.size(), 18U);
  expectSame(bytesOf(loadBoth()), without, "found");
  EXPECT_EQ(filesIn(cache_folder()), files);
}

TEST_F(PreparationCacheTest, ATrackedRunIsTheSame) {
  const auto distances_of = [](const Scene& scene) {
    PairTracker tracker("pair", scene.bodies[0].mesh, scene.bodies[1].mesh, TrackerParameters());
    PairSolution solution;
    test::Bytes bytes;
    for (int k = 0; k < 20; ++k) {
      tracker.update(test::translation({0.1, 0.05 * k, 1.5}), 0.01 * k, solution);
      for (const TrackedNiche& niche : solution.niches) {
        test::appendBytes(niche.id, bytes);
        test::appendBytes(niche.distance, bytes);
        test::appendBytes(niche.point_a_in_a, bytes);
        test::appendBytes(niche.point_b_in_a, bytes);
        test::appendBytes(niche.prominence, bytes);
      }
    }
    EXPECT_FALSE(bytes.empty());
    return bytes;
  };
  const test::Bytes missed = distances_of(loadBoth());
  EXPECT_TRUE(distances_of(loadBoth()) == missed);
}

TEST_F(PreparationCacheTest, FilesThatAreNotSoundAreMadeAnew) {
  const std::string comb = "bodies: [{name: comb, mesh: comb.stl, max_edge_length: 0.3}]\n";
  const auto expected = bytesOf(load(comb));
  for (const std::string& file : filesIn(cache_folder())) {
    const std::string sound = test::contentOf(file);
    const std::string name = std::filesystem::path(file).filename().string();
    std::string flipped = sound;
    flipped[sound.size() / 2] = static_cast<char>(flipped[sound.size() / 2] ^ '\x10');
    std::string older = sound;
    older[8] = static_cast<char>(older[8] - 1);  // the format's number
    std::string other_order = sound;
    std::reverse(other_order.begin() + 12, other_order.begin() + 16);
    for (const std::string& bad :
         {sound.substr(0, sound.size() / 3), sound.substr(0, sound.size() - 1), std::string(), flipped, older,
          other_order, std::string(sound.size(), '\0')}) {
      folder.write("cache/" + name, bad);
      expectSame(bytesOf(load(comb)), expected, file);
      // Some bytes between fields carry nothing and may differ; the size may not.
      EXPECT_EQ(std::filesystem::file_size(file), sound.size()) << "replaced: " << file;
      EXPECT_TRUE(test::contentOf(file) != bad);
    }
  }
}

TEST_F(PreparationCacheTest, EveryInputThatChangesIsAnotherKey) {
  const auto files_after = [&](const std::string& body) {
    std::filesystem::remove_all(cache_folder());
    bytesOf(load("bodies:\n  - {name: a, " + body + "}\n"));  // makes all parts
    return filesIn(cache_folder());
  };
  const std::vector<std::string> bodies = {
      "mesh: comb.stl",
      "mesh: comb.stl, max_edge_length: 0.1",
      "mesh: comb.stl, max_edge_length: 0.1000001",
      "mesh: comb.stl, scale: 2",
      "mesh: comb.stl, scale: [1, 1, -1]",
      "mesh: comb.stl, pose: {xyz: [0, 0, 1e-9]}",
      "mesh: ball.ply",
      "box: {size: [1, 1, 1]}",
      "box: {size: [1, 1, 1.0000001]}",
      "sphere: {radius: 1}",
      "sphere: {radius: 1}, chord_error: 0.02",
      "cylinder: {radius: 1, length: 2}",
      "capsule: {radius: 1, length: 2}",
  };
  std::map<std::string, std::string> body_of_file;
  for (const std::string& body : bodies) {
    const std::vector<std::string> files = files_after(body);
    EXPECT_EQ(files.size(), 9U) << body;
    for (const std::string& file : files) {
      const std::string ending = std::filesystem::path(file).extension().string();
      if (ending != ".nodes" && ending != ".metric") continue;  // what any input changes
      EXPECT_TRUE(body_of_file.emplace(file, body).second) << body << " and " << body_of_file[file];
    }
  }
  // The same body, with memory for the matrices and without, and the same name with another content.
  const std::vector<std::string> with = files_after("mesh: comb.stl");
  options.metric_memory_limit = 0;
  EXPECT_NE(files_after("mesh: comb.stl"), with);
  options.metric_memory_limit = kDefaultMetricMemoryLimit;
  exportMesh(test::makeComb(5), folder.path("comb.stl"));
  const std::vector<std::string> changed = files_after("mesh: comb.stl");
  for (const std::string& file : changed) {
    EXPECT_EQ(std::count(with.begin(), with.end(), file), 0) << file;
  }
}

TEST_F(PreparationCacheTest, AChangedFileIsReadAnew) {
  const double before = loadBoth().bodies[0].mesh->diameter();
  exportMesh(test::makeComb(7), folder.path("comb.stl"));
  EXPECT_NE(loadBoth().bodies[0].mesh->diameter(), before);
}

TEST_F(PreparationCacheTest, AFileThatIsReplacedWhileItIsReadIsNotKeptUnderItsOldContent) {
  // The first import puts another file in the place of the second mesh; the second one may put it back.
  const std::string worker = std::filesystem::path(CONCAVE_DISTANCE_DISTANCE_QUERY).parent_path();
  const std::string robot =
      "<robot name='r'><link name='l'><collision><geometry><mesh "
      "filename='package://arm_description/comb.stl'/></geometry></collision>"
      "<collision><geometry><mesh "
      "filename='package://arm_description/ball.ply'/></geometry></collision></link></robot>";
  const auto diameter = [&] { return loadRobot(robot).bodies.at(0).mesh->diameter(); };
  const double expected = diameter();
  for (const bool put_back : {false, true}) {
    std::filesystem::remove_all(cache_folder());
    exportMesh(makeSphere(4.0, 0.1), folder.path("other.ply"));
    const std::string replacing = folder.write(
        "worker", "#!/bin/sh\nPATH=/usr/bin:/bin\ncd '" + folder.path() +
                      "'\nif [ -e other.ply ]; then mv ball.ply kept.ply; mv other.ply ball.ply\n" +
                      (put_back ? "else mv kept.ply ball.ply\n" : "") + "fi\nexec '" + worker +
                      "/mesh_import_worker' \"$@\"\n");
    std::filesystem::permissions(replacing, std::filesystem::perms::owner_all);
    ::setenv("CONCAVE_DISTANCE_IMPORT_WORKER", replacing.c_str(), 1);
    EXPECT_GT(diameter(), expected + 1.0);
    ::unsetenv("CONCAVE_DISTANCE_IMPORT_WORKER");
    EXPECT_EQ(std::filesystem::exists(folder.path("kept.ply")), !put_back);
    if (!put_back) std::filesystem::rename(folder.path("kept.ply"), folder.path("ball.ply"));
    EXPECT_EQ(diameter(), expected) << "put back: " << put_back;
  }
}

TEST_F(PreparationCacheTest, TwoProcessesAtOnceGetTheSame) {
  options.cache = nullptr;
  const auto expected = bytesOf(loadBoth());
  folder.write("poses.csv", "t,x,y,z,qx,qy,qz,qw\n0,0,0,3,0,0,0,1\n");
  for (int round = 0; round < 3; ++round) {
    std::filesystem::remove_all(cache_folder());
    std::vector<pid_t> children;
    for (int k = 0; k < 2; ++k) {
      const pid_t child = ::fork();
      ASSERT_GE(child, 0);
      if (child == 0) {
        // A program of its own: threads do not come along through a fork.
        const std::string command = std::string(CONCAVE_DISTANCE_DISTANCE_QUERY) + " --cache " +
                                    cache_folder() + " --mesh-a " + folder.path("comb.stl") + " --mesh-b " +
                                    folder.path("ball.ply") + " --poses " + folder.path("poses.csv") +
                                    " --output " + folder.path("out" + std::to_string(k) + ".csv");
        ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
        ::_exit(127);
      }
      children.push_back(child);
    }
    for (const pid_t child : children) {
      int status = 0;
      ::waitpid(child, &status, 0);
      EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    }
    for (const std::string& file : filesIn(cache_folder())) EXPECT_FALSE(mentions(file, ".tmp")) << file;
    options.cache = std::make_shared<PreparationCache>(cache_folder());
    expectSame(bytesOf(loadBoth()), expected, "after two processes");
  }
}

TEST_F(PreparationCacheTest, AFolderThatCannotBeWrittenIsToldOnceAndStopsNothing) {
  folder.write("cache", "a file where the folder should be");
  const Scene scene = loadBoth();
  EXPECT_EQ(scene.bodies.size(), 2U);
  int told = 0;
  for (const std::string& note : scene.notes) told += mentions(note, "not stored") ? 1 : 0;
  EXPECT_EQ(told, 1);
  EXPECT_TRUE(test::hasNote(scene, cache_folder()));
  EXPECT_FALSE(test::hasNote(loadBoth(), "not stored"));
}

TEST_F(PreparationCacheTest, AFullDiskStopsNothing) {
  const auto expected = bytesOf(loadBoth("cache: 'off'\n"));
  // Files may not grow beyond a page, as if the disk had no more room.
  const auto restore = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{4096, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const Scene scene = loadBoth();
  const auto found = bytesOf(scene);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, restore);
  expectSame(found, expected, "full");
  EXPECT_TRUE(test::hasNote(scene, "not stored"));
  for (const std::string& file : filesIn(cache_folder())) EXPECT_FALSE(mentions(file, ".tmp")) << file;
  expectSame(bytesOf(loadBoth()), expected, "afterwards");
}

TEST_F(PreparationCacheTest, TheSceneFileGoesBeforeTheCaller) {
  bytesOf(loadBoth("cache: 'off'\n"));
  EXPECT_TRUE(filesIn(cache_folder()).empty());
  bytesOf(loadBoth("cache: kept/here\n"));  // from the scene file's folder on
  EXPECT_TRUE(filesIn(cache_folder()).empty());
  EXPECT_EQ(filesIn(folder.path("kept/here")).size(), 18U);
  EXPECT_TRUE(mentions(refusal("cache: ''\n"), "cache"));
}

TEST(PreparationCache, TheDefaultFolderIsTheUsers) {
  const char* old_cache = std::getenv("XDG_CACHE_HOME");
  const std::string kept = old_cache == nullptr ? "" : old_cache;
  ::setenv("XDG_CACHE_HOME", "/somewhere", 1);
  EXPECT_EQ(PreparationCache::defaultFolder(), "/somewhere/concave_distance");
  ::setenv("XDG_CACHE_HOME", "relative", 1);
  EXPECT_EQ(PreparationCache::defaultFolder(), std::string(std::getenv("HOME")) + "/.cache/concave_distance");
  ::unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(PreparationCache::defaultFolder(), std::string(std::getenv("HOME")) + "/.cache/concave_distance");
  if (old_cache != nullptr) ::setenv("XDG_CACHE_HOME", kept.c_str(), 1);
  EXPECT_EQ(openPreparationCache("off"), nullptr);
  EXPECT_EQ(openPreparationCache("/here")->folder(), "/here");
}

}  // namespace
}  // namespace concave_distance::preparation_cache_test
