#include "bag_transforms.h"

#include <fcntl.h>
#include <ros/serialization.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <tf2_msgs/TFMessage.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <system_error>

#include "bag_reader.h"
#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "ros/time_difference.h"

namespace concave_distance {
namespace {

// Without its texts a TransformStamped has 3 lengths, a sequence number, a stamp and 7 doubles.
constexpr std::size_t kLeastTransformLength = 80;
constexpr rlim_t kMostMemory = 4'000'000'000;  // bytes of addresses of the process that reads

// Why the bytes are no TFMessage; else fills the transforms.
std::string parse(std::vector<std::uint8_t>& bytes,
                  std::vector<geometry_msgs::TransformStamped>& transforms) {
  std::uint32_t count = 0;
  if (bytes.size() < sizeof count) return "it has " + std::to_string(bytes.size()) + " bytes";
  ros::serialization::IStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::deserialize(stream, count);
  // An invented count would take all memory before the end of the bytes is seen.
  if (count > bytes.size() / kLeastTransformLength) {
    return "it has " + std::to_string(bytes.size()) + " bytes for " + std::to_string(count) + " transforms";
  }
  transforms.resize(count);
  for (geometry_msgs::TransformStamped& transform : transforms) {
    ros::serialization::deserialize(stream, transform);
  }
  return "";
}

/// Numbers and texts through a pipe, between two processes of one program.
class Pipe {
 public:
  enum Kind : std::uint8_t { kOpened, kMessage, kEnd, kError };

  Pipe(int descriptor, const char* mode) : file_(fdopen(descriptor, mode)) {
    if (file_ == nullptr) throw std::system_error(errno, std::generic_category(), "a pipe");
  }
  ~Pipe() { std::fclose(file_); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  template <typename Number>
  void put(Number number) {
    std::fwrite(&number, sizeof number, 1, file_);
  }
  template <typename Bytes>
  void putBytes(const Bytes& bytes) {
    put(static_cast<std::uint64_t>(bytes.size()));
    std::fwrite(bytes.data(), 1, bytes.size(), file_);
  }
  /// False where nobody reads.
  bool isWhole() const { return std::ferror(file_) == 0; }

  /// False at the end.
  template <typename Number>
  bool get(Number& number) {
    return std::fread(&number, sizeof number, 1, file_) == 1;
  }
  template <typename Bytes>
  bool getBytes(Bytes& bytes) {
    std::uint64_t size = 0;
    if (!get(size)) return false;
    bytes.resize(size);
    return std::fread(bytes.data(), 1, size, file_) == size;
  }

 private:
  std::FILE* file_;
};

void sendError(const Error& error, Pipe& pipe) {
  pipe.put(Pipe::kError);
  for (const std::string& text : {error.where(), error.whatIsWrong(), error.remedy()}) pipe.putBytes(text);
}

// All that the process does that reads. Its signals are left to the one that waits for it.
void serve(const BagSelection& selection, Pipe& pipe) {
  const std::string where = joinedText(selection.paths, ", ");
  try {
    BagReader reader(selection);
    pipe.put(Pipe::kOpened);
    for (const ros::Time time : {reader.begin(), reader.end()}) pipe.put(time.toNSec());
    for (BagRecord record; pipe.isWhole() && reader.next(record);) {
      pipe.put(Pipe::kMessage);
      pipe.put(record.time.toNSec());
      pipe.put(record.fixed);
      pipe.putBytes(record.sender);
      pipe.putBytes(record.bytes);
    }
    pipe.put(Pipe::kEnd);
  } catch (const Error& error) {
    sendError(error, pipe);
  } catch (const std::bad_alloc&) {
    sendError(Error(where, "a part of it takes too much memory", kReindex), pipe);
  } catch (const std::exception& error) {
    sendError(Error(where, std::string("it is cut off or damaged: ") + error.what(), kReindex), pipe);
  }
}

void limitMemory() {
#ifndef __SANITIZE_ADDRESS__
  rlimit limit{};
  getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = std::min(limit.rlim_cur, kMostMemory);
  setrlimit(RLIMIT_AS, &limit);
#endif
}

ros::Time timeOf(std::uint64_t nanoseconds) {
  ros::Time time;
  return time.fromNSec(nanoseconds);
}

}  // namespace

struct BagTransforms::Reader {
  explicit Reader(const BagSelection& selection) : where(joinedText(selection.paths, ", ")) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "a pipe");
    const pid_t parent = getpid();
    pid = fork();
    if (pid == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != parent) _exit(1);
      std::signal(SIGINT, SIG_IGN);
      std::signal(SIGTERM, SIG_IGN);
      close(ends[0]);
      limitMemory();
      {
        Pipe output(ends[1], "wb");
        serve(selection, output);
      }
      _exit(0);
    }
    close(ends[1]);
    if (pid < 0) {
      close(ends[0]);
      throw std::system_error(errno, std::generic_category(), "a process that reads the bag");
    }
    input = std::make_unique<Pipe>(ends[0], "rb");
  }
  ~Reader() {
    input.reset();
    end();
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// Ends the process, if it has not ended, and returns its status.
  int end() {
    int status = 0;
    if (pid <= 0) return status;
    kill(pid, SIGKILL);
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
    pid = -1;
    return status;
  }

  [[noreturn]] void fail() {
    const int status = end();
    const std::string how = WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : "an exit";
    const std::string begin_text =
        is_open ? damagedAt(secondsBetween(begin, last)) : std::string("it is cut off or damaged: ");
    throw Error(where, begin_text + "what stands there has ended the process that reads it (" + how + ")",
                is_open ? kReindex : "rosbag reindex " + where);
  }

  Pipe::Kind nextKind() {
    Pipe::Kind kind = Pipe::kEnd;
    if (!input->get(kind)) fail();
    if (kind != Pipe::kError) return kind;
    std::array<std::string, 3> texts;
    for (std::string& text : texts) {
      if (!input->getBytes(text)) fail();
    }
    throw Error(texts[0], texts[1], texts[2]);
  }

  ros::Time nextTime() {
    std::uint64_t nanoseconds = 0;
    if (!input->get(nanoseconds)) fail();
    return timeOf(nanoseconds);
  }

  std::string where;
  pid_t pid = -1;
  std::unique_ptr<Pipe> input;
  bool is_open = false;
  ros::Time begin;
  ros::Time end_time;
  ros::Time last;
  std::vector<std::uint8_t> bytes;
};

BagTransforms::BagTransforms(const BagSelection& selection) : reader_(std::make_unique<Reader>(selection)) {
  reader_->nextKind();
  reader_->begin = reader_->last = reader_->nextTime();
  reader_->end_time = reader_->nextTime();
  reader_->is_open = true;
}

BagTransforms::~BagTransforms() = default;

ros::Time BagTransforms::begin() const {
  return reader_->begin;
}

ros::Time BagTransforms::end() const {
  return reader_->end_time;
}

bool BagTransforms::next(BagMessage& message) {
  Reader& reader = *reader_;
  if (reader.nextKind() == Pipe::kEnd) return false;
  message.time = reader.last = reader.nextTime();
  if (!reader.input->get(message.fixed) || !reader.input->getBytes(message.sender) ||
      !reader.input->getBytes(reader.bytes))
    reader.fail();
  message.transforms.clear();
  try {
    message.problem = parse(reader.bytes, message.transforms);
  } catch (const std::exception& problem) {
    message.problem = problem.what();
  }
  if (!message.problem.empty()) message.transforms.clear();
  return true;
}

}  // namespace concave_distance
