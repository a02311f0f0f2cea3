#include "mesh/import/import_process.h"

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/import/export_mesh.h"
#include "concave_distance/mesh/import/import_mesh.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "mesh/import/import_stream.h"
#include "support/hostile_mesh_files.h"
#include "support/temporary_folder.h"

namespace concave_distance::import_process_test {
namespace {

using detail::ImportHeader;
using detail::ImportStatus;
using test::TemporaryFolder;

const std::string kTetrahedron = CONCAVE_DISTANCE_TEST_DATA "/mesh/tetrahedron.obj";

std::size_t openDescriptors() {
  const std::filesystem::directory_iterator folder("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(folder), end(folder)));
}

template <typename Value>
std::string bytesOf(const Value& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

std::string headerBytes(ImportStatus status, std::uint64_t first, std::uint64_t second) {
  ImportHeader header;
  header.status = status;
  header.first = first;
  header.second = second;
  return bytesOf(header);
}

// Programs in the worker's place, and that none of them leaves a process or a descriptor behind.
class ImportProcess : public testing::Test {
 protected:
  ~ImportProcess() override {
    EXPECT_EQ(openDescriptors(), descriptors_);
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a process is left";
    EXPECT_EQ(errno, ECHILD);
  }

  std::string script(const std::string& commands) const {
    const std::string path = folder_.write("worker", "#!/bin/sh\n" + commands + "\n");
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path;
  }

  /// A worker that gives this answer.
  std::string answering(const std::string& bytes) const {
    return script("cat '" + folder_.write("answer", bytes) + "' >&4");
  }

  static TriangleSoup import(const std::string& worker, const MeshImportLimits& limits = {},
                             const std::string& path = kTetrahedron) {
    return detail::importInProcess(worker, MeshFile(path), Eigen::Vector3d::Ones(), limits);
  }

  static std::string refusalOf(const std::string& worker, const MeshImportLimits& limits = {},
                               const std::string& path = kTetrahedron) {
    try {
      import(worker, limits, path);
    } catch (const Error& error) {
      EXPECT_EQ(error.where(), path);
      EXPECT_FALSE(error.remedy().empty());
      return error.what();
    }
    ADD_FAILURE() << "accepted";
    return {};
  }

  static bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  std::size_t descriptors_ = openDescriptors();
  TemporaryFolder folder_;
};

TEST_F(ImportProcess, ReadsWhatTheWorkerAnswers) {
  const TriangleSoup soup = import(detail::importWorkerPath());
  EXPECT_EQ(soup.triangles.size(), 4U);
}

TEST_F(ImportProcess, ACrashIsARefusal) {
  for (const std::string signal : {"SEGV", "ABRT", "BUS", "FPE", "ILL"}) {
    const std::string refusal = refusalOf(script("kill -" + signal + " $$"));
    EXPECT_TRUE(says(refusal, "crashed on it (signal ")) << refusal;
  }
  EXPECT_TRUE(says(refusalOf(script("kill -KILL $$")), "memory is short"));
  EXPECT_TRUE(says(refusalOf(script("kill -TERM $$")), "interrupted"));
}

TEST_F(ImportProcess, AHangIsARefusal) {
  MeshImportLimits limits;
  limits.seconds = 0.3;
  for (const std::string commands : {"exec sleep 1000", "trap '' TERM INT; while :; do :; done"}) {
    const std::string refusal = refusalOf(script(commands), limits);
    EXPECT_TRUE(says(refusal, "more than 0.3")) << refusal;
    EXPECT_TRUE(says(refusal, "~limits/import_seconds")) << refusal;
  }
  const std::string half = headerBytes(ImportStatus::Read, 3, 1) + "half of it";
  const std::string answer = folder_.write("half", half);
  EXPECT_TRUE(says(refusalOf(script("cat '" + answer + "' >&4; exec sleep 1000"), limits), "more than 0.3"));
}

TEST_F(ImportProcess, AStopFlagEndsIt) {
  std::atomic<bool> stop{false};
  MeshImportLimits limits;
  limits.seconds = 1e6;
  limits.stop = &stop;
  EXPECT_EQ(import(detail::importWorkerPath(), limits).triangles.size(), 4U);
  const std::string started = folder_.path("started");
  std::thread other([&] {
    while (!std::filesystem::exists(started)) std::this_thread::yield();
    stop = true;
  });
  EXPECT_TRUE(says(refusalOf(script("touch '" + started + "'; exec sleep 1000"), limits), "interrupted"));
  other.join();
}

TEST_F(ImportProcess, AWorkerThatClosesItsAnswerAndGoesOnIsEnded) {
  const std::string refusal = refusalOf(script("exec 4>&-; exec sleep 1000"));
  EXPECT_TRUE(says(refusal, "ended") || says(refusal, "no answer")) << refusal;
}

TEST_F(ImportProcess, NothingOfAnAnswerIsBelieved) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string corners = bytesOf(Eigen::Vector3d(0, 0, 0)) + bytesOf(Eigen::Vector3d(1, 0, 0)) +
                              bytesOf(Eigen::Vector3d(0, 1, 0));
  const std::string triangle = bytesOf(std::array<std::uint32_t, 3>{0, 1, 2});
  const std::string header = headerBytes(ImportStatus::Read, 3, 1);
  ASSERT_EQ(import(answering(header + corners + triangle)).triangles.size(), 1U);

  std::string other_version = header;
  other_version[0] ^= 1;
  const std::string bad_corner = corners.substr(24) + bytesOf(Eigen::Vector3d(0, nan, 0));
  for (const std::string& answer : {
           std::string(5000, 'x'),
           other_version + corners + triangle,
           headerBytes(static_cast<ImportStatus>(77), 3, 1) + corners + triangle,
           headerBytes(ImportStatus::Read, 0xffffffffffffffffULL, 1) + corners,
           headerBytes(ImportStatus::Read, 0xfffffff0U, 0xfffffff0U) + corners,
           headerBytes(ImportStatus::Read, 3, 0) + corners,
           headerBytes(ImportStatus::Refused, 0xffffffffffffffffULL, 1) + corners,
           header + corners + bytesOf(std::array<std::uint32_t, 3>{0, 1, 3}),
           header + bad_corner + triangle,
       }) {
    const std::string refusal = refusalOf(answering(answer));
    EXPECT_TRUE(says(refusal, "an invalid answer")) << refusal;
  }
  for (const std::size_t size : {std::size_t{0}, std::size_t{31}, std::size_t{32}, std::size_t{100}}) {
    const std::string whole = header + corners + triangle;
    EXPECT_TRUE(says(refusalOf(answering(whole.substr(0, size))), "no answer"));
  }
}

TEST_F(ImportProcess, AMissingWorkerIsNamedWithTheRemedy) {
  for (const std::string& worker :
       {folder_.path("no_such_program"), folder_.path(), folder_.write("plain_file", "x")}) {
    const std::string refusal = refusalOf(worker);
    EXPECT_TRUE(says(refusal, "cannot be started") || says(refusal, "status 127")) << refusal;
    EXPECT_TRUE(says(refusal, worker)) << refusal;
    EXPECT_TRUE(says(refusal, "CONCAVE_DISTANCE_IMPORT_WORKER")) << refusal;
  }
  EXPECT_TRUE(says(refusalOf(script("exit 3")), "status 3"));
}

TEST_F(ImportProcess, TheEnvironmentMayNameTheWorker) {
  const char* variable = "CONCAVE_DISTANCE_IMPORT_WORKER";
  const char* set = std::getenv(variable);
  const std::string before = set == nullptr ? "" : set;
  const std::string usual = detail::importWorkerPath();
  EXPECT_TRUE(std::filesystem::is_regular_file(usual)) << usual;
  ASSERT_EQ(setenv(variable, "/somewhere/else", 1), 0);
  EXPECT_EQ(detail::importWorkerPath(), "/somewhere/else");
  setenv(variable, before.c_str(), 1);  // an empty one counts as none
}

TEST_F(ImportProcess, HoldsTheLimits) {
  const std::string worker = detail::importWorkerPath();
  const std::string binary = folder_.path("box.stl");
  exportMesh(makeBox({1, 1, 1}), binary);
  MeshImportLimits limits;
  limits.largest_triangle_count = 12;
  EXPECT_EQ(import(worker, limits, binary).triangles.size(), 12U);
  limits.largest_triangle_count = 3;
  for (const std::string& path : {kTetrahedron, binary}) {
    EXPECT_TRUE(says(refusalOf(worker, limits, path), "~limits/largest_triangle_count"));
  }
  limits = {};
  limits.memory = 1'000'000;
  const std::string refusal =
      refusalOf(worker, limits, folder_.write("short.obj", std::string(800'000, ' ')));
  EXPECT_TRUE(says(refusal, "more than 1 MB")) << refusal;
  EXPECT_TRUE(says(refusal, "~limits/import_memory_mb")) << refusal;
  // A file larger than the limit is not even begun.
  EXPECT_TRUE(says(refusalOf("/no/worker", limits, folder_.write("long.obj", std::string(1'000'001, ' '))),
                   "more than 1 MB"));
}

// The program that embeds the core may do with SIGCHLD what it likes.
TEST_F(ImportProcess, WorksWhateverThisProgramDoesWithEndedChildren) {
  const auto restore = std::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(import(detail::importWorkerPath()).triangles.size(), 4U);
  EXPECT_TRUE(says(refusalOf(script("kill -SEGV $$")), "ended without an answer"));
  std::signal(SIGCHLD, [](int) {
    while (waitpid(-1, nullptr, WNOHANG) > 0) {
    }
  });
  for (int i = 0; i < 20; ++i) EXPECT_EQ(import(detail::importWorkerPath()).triangles.size(), 4U);
  refusalOf(script("kill -SEGV $$"));
  std::signal(SIGCHLD, restore);
}

TEST_F(ImportProcess, WorksWithBlockedAndIgnoredSignals) {
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  ASSERT_EQ(pthread_sigmask(SIG_BLOCK, &all, &before), 0);
  const auto restore = std::signal(SIGXCPU, SIG_IGN);
  EXPECT_EQ(import(detail::importWorkerPath()).triangles.size(), 4U);
  EXPECT_TRUE(says(refusalOf(script("kill -XCPU $$; exec sleep 1000")), "takes more than"));
  std::signal(SIGXCPU, restore);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

TEST_F(ImportProcess, WorksWhenTheStandardStreamsAreClosed) {
  const int output = dup(STDOUT_FILENO);
  close(STDOUT_FILENO);
  close(STDIN_FILENO);
  const std::size_t triangles = import(detail::importWorkerPath()).triangles.size();
  dup2(output, STDOUT_FILENO);
  dup2(output, STDIN_FILENO);
  close(output);
  EXPECT_EQ(triangles, 4U);
}

// Each file of test/support/hostile_meshes.py is served or refused, as the file says.
TEST(HostileMeshes, AreServedOrRefusedAndNothingElse) {
  const test::TemporaryFolder folder;
  const std::vector<test::HostileMesh> meshes = test::writeHostileMeshes(folder.path());
  ASSERT_GE(meshes.size(), 80U);
  for (const test::HostileMesh& mesh : meshes) {
    MeshImportLimits limits;
    limits.memory = 500'000'000;
    // A file that may be refused is given little time.
    if (mesh.expectation != "served") limits.seconds = 3.0;
    try {
      const TriangleSoup soup = importMesh(mesh.path, Eigen::Vector3d::Ones(), limits);
      EXPECT_NE(mesh.expectation, "refused") << mesh.name << ": " << soup.triangles.size() << " triangles";
    } catch (const Error& error) {
      EXPECT_NE(mesh.expectation, "served") << error.what();
      EXPECT_EQ(error.where(), mesh.path);
      EXPECT_FALSE(error.remedy().empty()) << error.what();
      EXPECT_LT(std::string(error.what()).size(), 1000U) << error.what();
    }
  }
}

}  // namespace
}  // namespace concave_distance::import_process_test
