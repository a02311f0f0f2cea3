#include "base/array_file.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <tbb/global_control.h>
#include <unistd.h>
#include <xxhash.h>

#include <filesystem>
#include <numeric>
#include <optional>

#include "support/temporary_folder.h"

namespace concave_distance::array_file_test {
namespace {

constexpr ContentKey kKey{3, 5};

struct Content {
  std::vector<double> numbers;
  std::vector<Eigen::Vector3d> points;
  std::uint32_t count = 0;

  friend bool operator==(const Content& l, const Content& r) {
    return l.numbers == r.numbers && l.points == r.points && l.count == r.count;
  }
};

Content contentOfSize(std::size_t size) {
  Content content;
  content.numbers.resize(size);
  std::iota(content.numbers.begin(), content.numbers.end(), 0.25);
  content.points = {{1, 2, 3}, {4, 5, 6}};
  content.count = 7;
  return content;
}

bool write(const std::string& path, const Content& content, const ContentKey& key = kKey) {
  ArrayFileWriter writer(path, key);
  writer.array(content.numbers);
  writer.array(content.points);
  writer.value(content.count);
  return writer.finish();
}

std::optional<Content> read(const std::string& path, const ContentKey& key = kKey) {
  ArrayFileReader reader(path, key);
  Content content;
  reader.array(content.numbers);
  reader.array(content.points);
  reader.value(content.count);
  if (!reader.finish()) return std::nullopt;
  return content;
}

TEST(ArrayFile, GivesBackWhatWasWritten) {
  const test::TemporaryFolder folder;
  for (const std::size_t size : {0U, 1U, 1000U, 500'000U}) {  // the last is hashed in several blocks
    const Content content = contentOfSize(size);
    ASSERT_TRUE(write(folder.path("file"), content));
    EXPECT_TRUE(read(folder.path("file")) == content) << size;
  }
}

TEST(ArrayFile, NoticesEveryByteThatChanges) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write(folder.path("file"), contentOfSize(10)));
  const std::string sound = test::contentOf(folder.path("file"));
  for (std::size_t i = 0; i < sound.size(); ++i) {
    for (const char bit : {'\x01', '\x80'}) {
      std::string flipped = sound;
      flipped[i] = static_cast<char>(flipped[i] ^ bit);
      folder.write("flipped", flipped);
      EXPECT_FALSE(read(folder.path("flipped"))) << "byte " << i;
    }
  }
}

TEST(ArrayFile, NoticesWhereverItBreaksOffAndWhatIsAppended) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write(folder.path("file"), contentOfSize(10)));
  const std::string sound = test::contentOf(folder.path("file"));
  for (std::size_t length = 0; length < sound.size(); ++length) {
    folder.write("cut", sound.substr(0, length));
    EXPECT_FALSE(read(folder.path("cut"))) << length << " bytes";
  }
  folder.write("long", sound + 'x');
  EXPECT_FALSE(read(folder.path("long")));
  folder.write("foreign", "a text that somebody put here\n");
  EXPECT_FALSE(read(folder.path("foreign")));
  EXPECT_FALSE(read(folder.path("missing")));
  EXPECT_FALSE(read(folder.path()));  // a folder
}

TEST(ArrayFile, IsOfOneKeyAndOneLayout) {
  const test::TemporaryFolder folder;
  const Content content = contentOfSize(10);
  ASSERT_TRUE(write(folder.path("file"), content));
  EXPECT_FALSE(read(folder.path("file"), ContentKey{3, 6}));
  ArrayFileReader as_floats(folder.path("file"), kKey);
  std::vector<float> floats;
  as_floats.array(floats);
  EXPECT_FALSE(as_floats.ok());
  ArrayFileReader too_little(folder.path("file"), kKey);
  std::vector<double> numbers;
  too_little.array(numbers);
  EXPECT_TRUE(too_little.ok());
  EXPECT_FALSE(too_little.finish());
}

TEST(ArrayFile, OneThatIsNotFinishedLeavesNothing) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write(folder.path("file"), contentOfSize(3)));
  {
    ArrayFileWriter writer(folder.path("file"), kKey);
    writer.array(std::vector<double>(100));
  }
  EXPECT_TRUE(read(folder.path("file")) == contentOfSize(3));
  const auto files = std::filesystem::directory_iterator(folder.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST(ArrayFile, SaysWhyItCannotBeWritten) {
  const test::TemporaryFolder folder;
  ArrayFileWriter writer(folder.path("no folder/file"), kKey);
  writer.array(std::vector<double>(100));
  EXPECT_FALSE(writer.finish());
  EXPECT_NE(writer.problem().find("no folder/file"), std::string::npos) << writer.problem();
}

TEST(ArrayFile, WhoeverReadsWhileOthersWriteMeetsAWholeFile) {
  const test::TemporaryFolder folder;
  const Content content = contentOfSize(20'000);
  ASSERT_TRUE(write(folder.path("file"), content));
  std::vector<pid_t> writers;
  for (int k = 0; k < 2; ++k) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      bool all = true;
      for (int i = 0; i < 50; ++i) all = write(folder.path("file"), content) && all;
      ::_exit(all ? 0 : 1);
    }
    writers.push_back(child);
  }
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(read(folder.path("file")) == content);
  for (const pid_t child : writers) {
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  }
}

TEST(ContentHash, DependsOnOrderSizesAndEveryByteAndNotOnThreads) {
  const auto key_of = [](std::string_view first, std::string_view second) {
    return ContentHasher().add(first).add(second).key();
  };
  EXPECT_EQ(key_of("ab", "c"), key_of("ab", "c"));
  EXPECT_NE(key_of("ab", "c"), key_of("a", "bc"));
  EXPECT_NE(key_of("a", "b"), key_of("b", "a"));
  EXPECT_NE(key_of("", "a"), key_of("a", ""));
  EXPECT_NE(ContentHasher().add(0.0).key(), ContentHasher().add(-0.0).key());
  std::vector<unsigned char> bytes(3'000'001);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<unsigned char>(i * i);
  const ContentKey whole = hashBytes(bytes.data(), bytes.size());
  for (const std::size_t threads : {1U, 2U, 3U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(hashBytes(bytes.data(), bytes.size()), whole);
  }
  for (const std::size_t i : {0U, 1'048'575U, 1'048'576U, 3'000'000U}) {
    bytes[i] ^= 1U;
    EXPECT_NE(hashBytes(bytes.data(), bytes.size()), whole) << i;
    bytes[i] ^= 1U;
  }
  EXPECT_NE(hashBytes(bytes.data(), bytes.size() - 1), whole);
}

// Before version 0.8 the values of XXH3 were not final, and others: keys of a cache that is made anew.
#if XXH_VERSION_NUMBER >= 800
TEST(ContentHash, IsXxh3) {
  // As `xxhsum -H2` gives it.
  const std::string text = "The quick brown fox jumps over the lazy dog";
  EXPECT_EQ(hashBytes(text.data(), text.size()).text(), "ddd650205ca3e7fa24a1cc2e3a8a7651");
  EXPECT_EQ(hashBytes(text.data(), 0).text(), "99aa06d3014798d86001c324468d497f");
}
#endif

}  // namespace
}  // namespace concave_distance::array_file_test
