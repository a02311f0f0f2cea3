// A pair that was followed is recorded in a folder, read from there and replayed: the same bits, for whatever
// bodies and settings a scene may have; and folders that are not what record_pair writes.
#include "loading/pair_record.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <cstring>
#include <filesystem>

#include "base/number_text.h"
#include "loading/pair_record_reader.h"
#include "mesh/import/obj_text.h"
#include "mesh/metric_memory.h"
#include "support/csv_table.h"
#include "support/random_solids.h"
#include "support/recorded_pair.h"
#include "support/scene_fixture.h"

namespace concave_distance::pair_record_test {
namespace {

using namespace detail;
using Eigen::Isometry3d;
using test::bodyOf;
using test::mentions;
using test::meshOf;
using test::RecordedPair;

constexpr int kCycles = 25;

struct Case {
  std::string name;
  SceneBody a;
  SceneBody b;
  PairSettings settings;
};

SurfaceMesh movedFar(SurfaceMesh mesh) {
  std::vector<Eigen::Vector3d> vertices = mesh.vertices();
  for (Eigen::Vector3d& vertex : vertices) vertex.array() += 1000.0 / 3.0;
  return {std::move(vertices), mesh.triangles(), "far"};
}

std::shared_ptr<const BodyMesh> bumpyBall(const BodyMeshOptions& options = {}) {
  return meshOf("ball", test::makeBumpyBall(0.4, 4e-3, 9.0), options);
}

std::vector<Case> cases() {
  const auto comb = [] { return bodyOf("comb", meshOf("comb", test::makeComb(3)), 0.0); };
  const auto hook = [] { return bodyOf("a:hook", meshOf("hook", test::makeHook())); };
  std::vector<Case> all = {{"plain", comb(), hook(), {}}};
  for (const AccuracyLevel level : {AccuracyLevel::Nodes, AccuracyLevel::Refined}) {
    all.push_back({"level " + std::string(toString(level)), comb(), hook(), {}});
    all.back().settings.tracker.accuracy = level;
  }
  all.push_back({"margins",
                 bodyOf("comb", meshOf("comb", test::makeComb(3)), 0.01),
                 bodyOf("hook", meshOf("hook", test::makeHook()), 1.0 / 300.0),
                 {}});
  RoundShape capsule = test::roundShape(RoundKind::Capsule, 0.11, 0.3);
  capsule.body_from_shape =
      Eigen::Translation3d(0.1, 0.2, 0.3) * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX());
  all.push_back({"round and mesh", comb(), bodyOf("pill", test::makeRoundBody(capsule)), {}});
  all.push_back({"two rounds",
                 bodyOf("ball", test::makeRoundBody(test::sphereOf(0.3))),
                 bodyOf("can", test::makeRoundBody(test::roundShape(RoundKind::Cylinder, 0.2, 0.1))),
                 {}});
  all.push_back({"modelled far away", comb(), bodyOf("far", meshOf("far", movedFar(test::makeHook()))), {}});
  BodyMeshOptions fine;
  fine.max_edge_length = 0.07;
  BodyMeshOptions no_room;
  no_room.metric_memory = std::make_shared<MetricMemory>(std::size_t{10});
  all.push_back(
      {"search without matrices", bodyOf("ball", bumpyBall(no_room)), bodyOf("other", bumpyBall(fine)), {}});
  all.back().settings.tracker.accuracy = AccuracyLevel::Refined;
  all.push_back({"many settings", comb(), hook(), {}});
  TrackerParameters& tracker = all.back().settings.tracker;
  tracker.cutoff = 0.9;
  tracker.seed = 77;
  tracker.hidden = tracker.signed_values = tracker.keep_through_material = true;
  tracker.prominence_limit = 0.5;
  tracker.largest_niche_count = 3;
  tracker.relative_tolerance = 0.01;
  tracker.time_budget = 1e-6;
  tracker.warm.population_size = 24;
  all.back().settings.warning_distance = 0.1;
  all.back().settings.effects.interference = true;
  return all;
}

class PairRecordTest : public ::testing::Test {
 protected:
  PairRecording record(const Case& one) {
    RecordedPair pair(one.a, one.b, one.settings);
    test::Motion motion = test::passingMotion();
    if (one.name == "modelled far away") motion.centre.array() -= 1000.0 / 3.0;
    pair.run(motion, kCycles);
    return *pair.take();
  }
  PairRecording plain() { return record(cases().front()); }

  std::string refusal() const {
    try {
      const LoadedRecord loaded = loadRecord(folder_.path("record"));
      compareAnswers(folder_.path("record"), loaded.answers, answersTo(loaded.record, kNoCycleEnd));
      return "accepted";
    } catch (const Error& error) {
      return error.what();
    }
  }
  std::string content(const std::string& file) const {
    return test::contentOf(folder_.path("record/" + file));
  }
  void write(const std::string& file, const std::string& text) { folder_.write("record/" + file, text); }

  test::TemporaryFolder folder_;
};

TEST_F(PairRecordTest, IsReplayedToTheSameBits) {
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    const std::string folder = folder_.path(one.name);
    const PairRecording recording = record(one);
    ASSERT_EQ(recording.cycles.size(), static_cast<std::size_t>(kCycles));
    const RecordAnswers written = test::writeRecording(recording, folder);
    LoadedRecord loaded = loadRecord(folder);
    EXPECT_EQ(loaded.answers.count, static_cast<std::size_t>(kCycles));
    ASSERT_EQ(loaded.record.poses.size(), recording.cycles.size());
    for (std::size_t i = 0; i < recording.cycles.size(); ++i) {
      EXPECT_EQ(std::memcmp(loaded.record.poses[i].pose.data(), recording.cycles[i].pose().data(), 128), 0);
      EXPECT_EQ(loaded.record.poses[i].time, recording.cycles[i].time);
    }
    const RecordAnswers again = answersTo(loaded.record, kNoCycleEnd);
    EXPECT_EQ(again.answers, written.answers);
    EXPECT_EQ(again.niches, written.niches);
    EXPECT_TRUE(compareAnswers(folder, loaded.answers, again).isNone());
  }
}

// A tracker of its own says of the recorded bodies what the recording holds.
TEST_F(PairRecordTest, HoldsWhatATrackerAnswers) {
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    const std::string folder = folder_.path(one.name);
    const PairRecording recording = record(one);
    test::writeRecording(recording, folder);
    TrackerParameters parameters = withMargins(one.settings.tracker, one.a, one.b);
    parameters.time_budget = std::numeric_limits<double>::infinity();
    PairTracker tracker(recording.pair->name, one.a.mesh, one.b.mesh, parameters);
    PairSolution solution;
    const std::vector<test::Row> rows = test::readTable(folder + "/answers.csv");
    const std::vector<test::Row> niches = test::readTable(folder + "/niches.csv");
    ASSERT_EQ(rows.size(), recording.cycles.size());
    std::size_t niche = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].at("status") == "beyond_cutoff") continue;
      tracker.update(recording.cycles[i].pose(), recording.cycles[i].time, solution);
      EXPECT_EQ(test::number(rows[i], "distance"), solution.distance);
      EXPECT_EQ(test::number(rows[i], "ax"), solution.point_a_in_a.x());
      EXPECT_EQ(test::number(rows[i], "bz"), solution.point_b_in_a.z());
      EXPECT_EQ(test::number(rows[i], "niche_count"), static_cast<double>(solution.niches.size()));
      for (const TrackedNiche& known : solution.niches) {
        ASSERT_LT(niche, niches.size());
        EXPECT_EQ(test::number(niches[niche], "niche"), static_cast<double>(known.id));
        EXPECT_EQ(test::number(niches[niche], "distance"), known.distance);
        EXPECT_EQ(test::number(niches[niche], "by"), known.point_b_in_a.y());
        ++niche;
      }
    }
    EXPECT_EQ(niche, niches.size());
  }
}

TEST_F(PairRecordTest, SaysWhatTheNodeAnsweredAndHowItIsSet) {
  Case one = cases().back();
  RecordedPair pair(one.a, one.b, one.settings);
  pair.run(0.0, test::passingMotion().at(0.0));
  pair.run(0.1, std::nullopt);
  pair.run(0.2, Isometry3d(Eigen::Translation3d(9, 9, 9)));
  test::writeRecording(*pair.take(), folder_.path("record"));
  const std::vector<test::Row> live = test::readTable(folder_.path("record/live.csv"));
  ASSERT_EQ(live.size(), 2U);
  EXPECT_EQ(live[0].at("missed_before"), "0");
  EXPECT_EQ(live[1].at("missed_before"), "1");
  EXPECT_EQ(live[1].at("status"), "beyond_cutoff");
  EXPECT_EQ(test::readTable(folder_.path("record/answers.csv"))[1].at("status"), "beyond_cutoff");
  const std::string facts = content("record.yaml");
  for (const char* part :
       {"time_budget: 1e-6", "seed: 77", "interference: true", "cutoff: 0.9", "\na:\n  name: comb\n",
        "epoch: \"1700000000.250000000\"", "warning_distance: 0.1", "compiler: "})
    EXPECT_TRUE(mentions(facts, part)) << part << " in " << facts;
}

TEST_F(PairRecordTest, EndsWithWhatWasAnsweredInTime) {
  const PairRecording recording = plain();
  const PairRecord record = recordOf(recording);
  const RecordAnswers none = answersTo(record, WorkLimit::Clock::now());
  EXPECT_LT(none.count, record.poses.size());
  writeFolder(folder_.path("record"), savedRecord(recording, record, none));
  const LoadedRecord loaded = loadRecord(folder_.path("record"));
  EXPECT_EQ(loaded.answers.count, none.count);
  EXPECT_EQ(loaded.record.poses.size(), record.poses.size()) << "the poses are whole";
}

TEST_F(PairRecordTest, ListsWhatDiffers) {
  test::writeRecording(plain(), folder_.path("record"));
  const auto differenceAfter = [&](const std::string& file, const std::string& text) {
    const std::string before = content(file);
    write(file, text);
    const LoadedRecord loaded = loadRecord(folder_.path("record"));
    write(file, before);
    return compareAnswers(folder_.path("record"), loaded.answers, answersTo(loaded.record, kNoCycleEnd));
  };
  const test::Row row = test::readTable(folder_.path("record/answers.csv")).at(7);
  const std::string cell = row.at("ax");
  const std::string nearby = numberText(test::number(row, "ax") + 0.25, 17);
  RecordDifference found = differenceAfter(
      "answers.csv", test::replaced(content("answers.csv"), "," + cell + ",", "," + nearby + ","));
  EXPECT_EQ(found.answers.other_rows, 1U);
  EXPECT_EQ(found.niches.other_rows, 0U);
  EXPECT_EQ(found.answers.first,
            folder_.path("record/answers.csv") + ":9: ax is " + cell + ", recorded: " + nearby);
  EXPECT_NEAR(found.answers.largest, 0.25, 1e-15);
  found = differenceAfter("niches.csv", test::replaced(content("niches.csv"), ",outward,1,", ",unknown,1,"));
  EXPECT_TRUE(mentions(found.niches.first, "niches.csv:2: outward is outward, recorded: unknown"))
      << found.niches.first;
  EXPECT_EQ(found.niches.other_rows, 1U);
  EXPECT_EQ(found.niches.largest, 0.0);
  // Another setting: the lists are shorter.
  found = differenceAfter("record.yaml", test::replaced(content("record.yaml"), "largest_niche_count: 64",
                                                        "largest_niche_count: 1"));
  EXPECT_GT(found.niches.other_rows, 0U);
  EXPECT_TRUE(mentions(found.niches.first, "pose 0 has 1 line, recorded: ")) << found.niches.first;
  // Other line ends are none.
  std::string windows;
  for (const char c : content("answers.csv")) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_TRUE(differenceAfter("answers.csv", windows).isNone());
}

TEST_F(PairRecordTest, RefusesAFolderThatIsDamaged) {
  test::writeRecording(plain(), folder_.path("record"));
  ASSERT_EQ(refusal(), "accepted");
  const auto cut = [&](const std::string& file, std::size_t lines) {
    const std::string text = content(file);
    std::size_t end = 0;
    for (std::size_t i = 0; i < lines; ++i) end = text.find('\n', end) + 1;
    return text.substr(0, end);
  };
  const auto change = [&](const std::string& file, const std::string& from, const std::string& to) {
    return test::replaced(content(file), from, to);
  };
  struct Damage {
    std::string file;
    std::string text;
    std::string message;
  };
  const std::string row = cut("answers.csv", 2).substr(cut("answers.csv", 1).size());
  const std::vector<Damage> damages = {
      {"record.yaml", "", "record.yaml:1: the value is empty (allowed: a map with format, pair, a and b)"},
      {"record.yaml", "a: [", "record.yaml:"},
      {"record.yaml", std::string(1'000'001, '#'), "record.yaml: it has 1000001 bytes"},
      {"record.yaml", cut("record.yaml", 4), "'poses' is missing"},
      {"record.yaml", change("record.yaml", "format: 1", "format: 2"),
       "format: it is format '2' (use distance_query of the version"},
      {"record.yaml", change("record.yaml", "poses: 25", "poses: 26"), "poses.csv: it has 25 poses of 26"},
      {"record.yaml", change("record.yaml", "poses: 25", "poses: 4000000000"),
       "poses: the value is '4000000000'"},
      {"record.yaml", change("record.yaml", "answered: 25", "answered: 26"), "answered: the value is '26'"},
      {"record.yaml", change("record.yaml", "answered: 25", "answered: 24"), "index is '24', of 24 poses"},
      {"record.yaml", change("record.yaml", "margin: 0", "margin: .nan"), "margin: the value is '.nan'"},
      {"record.yaml", change("record.yaml", "triangles: ", "triangles: 1"), "a.obj: it has "},
      {"record.yaml", change("record.yaml", "max_edge_length: auto", "max_edge_length: 1e-9"),
       "max_edge_length 1e-09 m makes"},
      {"record.yaml", change("record.yaml", "seed: 1", "seed: -1"), "seed: the value is '-1'"},
      {"record.yaml", change("record.yaml", "accuracy: certified", "accuracy: best"),
       "accuracy: the value is 'best'"},
      {"record.yaml", change("record.yaml", "accuracy: certified", "accurate: certified"), "accurate"},
      {"record.yaml", change("record.yaml", "  name: comb", "  shape: {kind: cube}\n  name: comb"),
       "kind: the value is 'cube'"},
      {"record.yaml",
       change(
           "record.yaml", "  name: comb",
           "  shape: {kind: sphere, radius: .inf, half_length: 0, chord_error: 1, pose: {}}\n  name: comb"),
       "radius: the value is '.inf'"},
      {"poses.csv", "", "poses.csv: the file is empty"},
      {"poses.csv", cut("poses.csv", 20), "poses.csv: it has 19 poses of 25"},
      {"poses.csv", content("poses.csv").substr(0, content("poses.csv").size() - 60),
       "poses.csv:26: it has "},
      {"poses.csv", change("poses.csv", "\n0,", "\nnan,"), "poses.csv:2: column t is 'nan'"},
      {"poses.csv", change("poses.csv", "\n0,", "\n0,nan,"), "it has 14 cells"},
      {"poses.csv", change("poses.csv", "\n0.02,", "\n-0.02,"), "pose 1: its time is before"},
      {"poses.csv", "t,x,y,z,qx,qy,qz,qw\n0,0,0,1,0,0,0,1\n", "its rotations are quaternions"},
      {"answers.csv", "", "answers.csv: it has 0 lines below its header, record.yaml says 25"},
      {"answers.csv", cut("answers.csv", 20),
       "answers.csv: it has 19 lines below its header, record.yaml says 25"},
      {"answers.csv", content("answers.csv").substr(0, content("answers.csv").size() - 3),
       "answers.csv:26: the file ends in the middle of this line"},
      {"answers.csv", change("answers.csv", "\n0,", "\n0,1,"), "answers.csv:2: it has 15 cells of 14"},
      {"answers.csv", change("answers.csv", "\n0,", "\nx,"), "column index is 'x'"},
      {"answers.csv", change("answers.csv", "\n0,", "\n0.5,"), "column index is '0.5', of 25 poses"},
      {"answers.csv", change("answers.csv", "\n1,", "\n0,"), "two lines have the index 0"},
      {"answers.csv", content("answers.csv") + "24" + row.substr(row.find(',')) + "\n",
       "answers.csv:27: there are more lines below the header than 25, as record.yaml says"},
      {"answers.csv", std::string(1000, ',') + "\n", "answers.csv:1: the columns are not those"},
      {"answers.csv", change("answers.csv", row, "0,nan" + row.substr(row.find(',', 2))),
       "answers.csv:2: column distance is 'nan'"},
      {"answers.csv", change("answers.csv", "index,distance", "index,depth"),
       "answers.csv:1: the columns are not those"},
      {"niches.csv", cut("niches.csv", 3),
       "niches.csv: it has 2 lines below its header, answers.csv counts "},
      {"niches.csv", change("niches.csv", "\n0,", "\n7,"), "comes after 7"},
      {"niches.csv", std::string(200'000, '\n'), "niches.csv:2: column index is ''"},
      {"a.obj", "", "a.obj: "},
      {"a.obj", cut("a.obj", 10), "a.obj"},
      {"a.obj", change("a.obj", "v ", "v nan "), "a.obj"},
      {"b.obj", change("b.obj", "f 1 ", "f 99999 "), "b.obj"},
      {"b.obj", content("a.obj"), "b.obj: it has "},
  };
  for (const Damage& damage : damages) {
    const std::string before = content(damage.file);
    write(damage.file, damage.text);
    const std::string message = refusal();
    EXPECT_TRUE(mentions(message, damage.message))
        << "expected: " << damage.message << "\nin: " << message << "\nfile: " << damage.text.substr(0, 300);
    write(damage.file, before);
  }
  for (const char* file : {"record.yaml", "poses.csv", "answers.csv", "niches.csv", "a.obj", "b.obj"}) {
    const std::string path = folder_.path("record/" + std::string(file));
    const std::string before = content(file);
    std::filesystem::remove(path);
    EXPECT_TRUE(mentions(refusal(), file)) << refusal();
    std::filesystem::create_directory(path);
    EXPECT_TRUE(mentions(refusal(), file)) << refusal();
    std::filesystem::remove(path);
    std::filesystem::create_symlink("/dev/zero", path);
    EXPECT_TRUE(mentions(refusal(), "it is not a regular file")) << refusal();
    std::filesystem::remove(path);
    ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
    EXPECT_TRUE(mentions(refusal(), "it is not a regular file")) << refusal();
    std::filesystem::remove(path);
    write(file, before);
  }
  EXPECT_EQ(refusal(), "accepted");
  std::filesystem::remove_all(folder_.path("record"));
  EXPECT_TRUE(mentions(refusal(), "there is no such folder (name the folder that record_pair has written)"));
}

// Bytes of its files changed, lost, doubled: an error that names a place in the folder, or a recording.
TEST_F(PairRecordTest, SurvivesBytesAtRandom) {
  test::writeRecording(plain(), folder_.path("record"));
  constexpr std::uint64_t kSeed = 3;
  constexpr int kChanges = 240;
  RandomEngine engine(kSeed);
  const std::string files[] = {"record.yaml", "poses.csv", "answers.csv", "niches.csv", "a.obj", "b.obj"};
  const std::string bytes =
      "0123456789.-,:{}[]\n\" \0\xff"
      "eEnaif*&!";
  int refused = 0;
  const auto below = [&](std::size_t count) {
    return uniformIndex(engine, static_cast<std::uint32_t>(count));
  };
  for (int i = 0; i < kChanges; ++i) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", change " + std::to_string(i));
    const std::string& file = files[i % 6];
    const std::string before = content(file);
    std::string text = before;
    for (std::uint64_t edits = 1 + below(4); edits > 0 && !text.empty(); --edits) {
      const std::size_t at = below(text.size());
      const std::size_t size = below(40);
      switch (below(4)) {
        case 0:
          text[at] = bytes[below(bytes.size())];
          break;
        case 1:
          text.erase(at, size);
          break;
        case 2:
          text.insert(at, text.substr(below(text.size()), size));
          break;
        default:
          text.resize(at);
      }
    }
    write(file, text);
    try {
      const LoadedRecord loaded = loadRecord(folder_.path("record"));
      const RecordAnswers now =
          answersTo(loaded.record, WorkLimit::Clock::now() + std::chrono::milliseconds(20));
      EXPECT_LE(now.count, loaded.record.poses.size());
    } catch (const Error& error) {
      ++refused;
      const std::string message = error.what();
      EXPECT_TRUE(mentions(message, "record") || mentions(message, "comb") || mentions(message, "hook"))
          << message;
    }
    write(file, before);
  }
  EXPECT_GT(refused, kChanges / 3);
  EXPECT_LT(refused, kChanges);
}

TEST_F(PairRecordTest, RefusesAMeshThatMakesTooLargeAFile) {
  const PairRecord record = recordOf(plain());
  std::size_t bytes = 0;
  for (const SceneBody* body : {record.body_a.get(), record.body_b.get()})
    bytes = std::max(bytes, objText(body->mesh->surface()).size());
  EXPECT_NO_THROW(requireRecordable(record));
  EXPECT_NO_THROW(requireRecordable(record, 3 * bytes));
  try {
    requireRecordable(record, bytes - 1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_TRUE(mentions(error.what(), "triangles is too large to record (simplify it")) << error.what();
  }
}

TEST_F(PairRecordTest, FoldersAreWholeOrNotThere) {
  const std::vector<SavedFile> files = {{"one", "1"}, {"two", "2"}};
  const std::string target = folder_.path("new");
  EXPECT_EQ(writeFolder(target, files), (std::vector<std::string>{target + "/one", target + "/two"}));
  const auto refused = [](const std::string& path, const std::vector<SavedFile>& what) {
    try {
      writeFolder(path, what);
      return std::string("accepted");
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  EXPECT_TRUE(mentions(refused(target, files), "it is there already (name another folder"))
      << "nothing is replaced";
  EXPECT_EQ(test::contentOf(target + "/one"), "1");
  EXPECT_TRUE(mentions(refused(folder_.path("none/new"), files), "the folder cannot be written"));
  EXPECT_TRUE(
      mentions(refused(folder_.path("other"), {{"one", "1"}, {"no/two", "2"}}), "nothing was written"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path("other")));
  // A disk that is full after a thousand bytes.
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{1000, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = refused(folder_.path("full"), {{"one", "1"}, {"two", std::string(5000, '2')}});
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_TRUE(mentions(message, "full: nothing was written: ")) << message;
  EXPECT_FALSE(std::filesystem::exists(folder_.path("full")));
  const auto all = std::filesystem::directory_iterator(folder_.path());
  EXPECT_EQ(std::distance(begin(all), end(all)), 1);
  for (const char* name : {"", ".", "..", "a/", "../x", "/etc/x"})
    EXPECT_THROW(placeBelow(folder_.path(), name, "folder"), Error) << name;
  try {
    placeBelow("", "x", "folder");
    FAIL() << "there is no folder";
  } catch (const Error& error) {
    EXPECT_STREQ(
        error.what(),
        "folder: no folder is known in which anything may be saved (set ~save_folder, and start the node "
        "again)");
  }
}

}  // namespace
}  // namespace concave_distance::pair_record_test
