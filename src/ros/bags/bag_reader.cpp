#include "bag_reader.h"

#include <console_bridge/console.h>
#include <ros/serialization.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <deque>
#include <exception>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>

#include "base/log_throttle.h"
#include "base/number_text.h"
#include "base/short_text.h"
#include "concave_distance/base/error.h"
#include "kinematics/frame_name.h"
#include "ros/time_difference.h"

namespace concave_distance {
namespace {

constexpr std::size_t kHeadLength = 4200;         // bytes; the record behind the first line is padded to 4096
constexpr std::size_t kMostLength = 256'000'000;  // bytes of a message

/// Keeps what rosbag's library says of messages that it leaves out, and prints it nowhere.
class Complaints : public console_bridge::OutputHandler {
 public:
  Complaints() { console_bridge::useOutputHandler(this); }
  ~Complaints() override { console_bridge::restorePreviousOutputHandler(); }
  Complaints(const Complaints&) = delete;
  Complaints& operator=(const Complaints&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char* /*file*/,
           int /*line*/) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && first_.empty()) first_ = text;
  }
  /// @throws std::runtime_error where something was left out
  void require() const {
    if (!first_.empty()) throw std::runtime_error(first_);
  }

 private:
  std::string first_;
};

std::string headOf(const std::string& path) {
  std::error_code failure;
  if (!std::filesystem::exists(path, failure)) {
    throw Error(path, "there is no such bag", "check its name");
  }
  if (!std::filesystem::is_regular_file(path, failure)) {
    throw Error(path, "it is no file", "name a bag, as rosbag record writes it");
  }
  std::ifstream file(path, std::ios::binary);
  std::string head(kHeadLength, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (file.bad() || !file.is_open()) throw Error(path, "it cannot be read", "check its permissions");
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}

// The name of the plugin that a bag was encrypted with; empty when it was not.
std::string encryptorOf(const std::string& head) {
  const std::string field = "encryptor=";
  const std::size_t begin = head.find(field);
  if (begin == std::string::npos) return "";
  const std::size_t name = begin + field.size();
  const auto is_of_name = [](char c) {
    return c == '/' || c == '_' || std::isalnum(static_cast<unsigned char>(c));
  };
  std::size_t end = name;
  while (end < head.size() && is_of_name(head[end])) ++end;
  return head.substr(name, end - name);
}

void openBag(const std::string& path, const Complaints& complaints, rosbag::Bag& bag) {
  const std::string head = headOf(path);
  if (head.rfind("#ROSBAG V", 0) != 0) {
    throw Error(path, "it is no bag of ROS 1", "name a bag, as rosbag record writes it");
  }
  const std::string encryptor = encryptorOf(head);
  try {
    bag.open(path, rosbag::bagmode::Read);
    complaints.require();
  } catch (const rosbag::BagUnindexedException&) {
    throw Error(path, "it has no index: its recording was not ended", "rosbag reindex " + path);
  } catch (const std::exception& problem) {
    if (!encryptor.empty()) {
      throw Error(
          path, "it is encrypted by " + encryptor + " and cannot be opened: " + problem.what(),
          "import the key with gpg, or decrypt the bag where it is: rosbag encrypt -p rosbag/NoEncryptor");
    }
    throw Error(path, std::string("it is cut off or damaged: ") + problem.what(), "rosbag reindex " + path);
  }
}

bool isOneOf(const std::vector<std::string>& topics, const std::string& topic) {
  return std::any_of(topics.begin(), topics.end(), [&](const std::string& wanted) {
    return withoutLeadingSlash(wanted) == withoutLeadingSlash(topic);
  });
}

bool isOfTf(const rosbag::ConnectionInfo& connection) {
  return connection.md5sum == ros::message_traits::MD5Sum<tf2_msgs::TFMessage>::value();
}

std::string quotedNames(const std::set<std::string>& names) {
  return names.empty() ? "none" : shortText(joinedText({names.begin(), names.end()}, ", "));
}

void requireTopics(const BagSelection& selection, const std::vector<const rosbag::ConnectionInfo*>& all) {
  const std::string where = joinedText(selection.paths, ", ");
  std::set<std::string> of_tf;
  std::set<std::string> found;
  for (const rosbag::ConnectionInfo* connection : all) {
    const std::string& topic = connection->topic;
    if (isOfTf(*connection)) of_tf.insert(topic);
    if (!isOneOf(selection.moving_topics, topic) && !isOneOf(selection.fixed_topics, topic)) continue;
    if (!isOfTf(*connection)) {
      throw Error(where,
                  "its topic " + printable(topic) + " has the type " + printable(connection->datatype) +
                      ", which is not tf2_msgs/TFMessage",
                  "name tf's topics with --tf-topic and --tf-static-topic; of that type there are: " +
                      quotedNames(of_tf));
    }
    found.insert(withoutLeadingSlash(topic));
  }
  std::vector<std::string> wanted = selection.moving_topics;
  wanted.insert(wanted.end(), selection.fixed_topics.begin(), selection.fixed_topics.end());
  std::vector<std::string> missing;
  for (const std::string& topic : wanted) {
    if (found.count(withoutLeadingSlash(topic)) == 0) missing.push_back(topic);
  }
  if (missing.empty() || (!selection.are_topics_given && missing.size() < wanted.size())) return;
  throw Error(where, "there is no message on " + joinedText(missing, " or "),
              "name tf's topics with --tf-topic and --tf-static-topic; topics of type tf2_msgs/TFMessage: " +
                  quotedNames(of_tf));
}

}  // namespace

struct BagReader::Bags {
  explicit Bags(const BagSelection& chosen) : selection(chosen) {}

  const BagSelection selection;
  const Complaints complaints;
  std::deque<rosbag::Bag> files;
  rosbag::View before;  ///< static transforms before the start
  rosbag::View played;
  rosbag::View::iterator place;
  bool is_before = true;
  ros::Time begin;
  ros::Time end;
  ros::Time last;
};

BagReader::BagReader(const BagSelection& selection) : bags_(std::make_unique<Bags>(selection)) {
  rosbag::View whole;
  for (const std::string& path : selection.paths) {
    openBag(path, bags_->complaints, bags_->files.emplace_back());
    whole.addQuery(bags_->files.back());
  }
  requireTopics(selection, whole.getConnections());
  const ros::Time begin = whole.getBeginTime();
  const ros::Time end = whole.getEndTime();
  const double length = secondsBetween(begin, end);
  if (selection.start > length) {
    throw Error("--start", "it is " + numberText(selection.start) + " s, behind the end",
                "the bags last " + numberText(length, 9) + " s");
  }
  bags_->begin = begin + ros::Duration(selection.start);
  bags_->end = selection.duration && *selection.duration < length - selection.start
                   ? bags_->begin + ros::Duration(*selection.duration)
                   : end;
  const auto is_fixed = [this](const rosbag::ConnectionInfo* connection) {
    return isOneOf(bags_->selection.fixed_topics, connection->topic);
  };
  const auto is_wanted = [this, is_fixed](const rosbag::ConnectionInfo* connection) {
    return is_fixed(connection) || isOneOf(bags_->selection.moving_topics, connection->topic);
  };
  for (const rosbag::Bag& file : bags_->files) {
    if (selection.start > 0.0) {
      bags_->before.addQuery(file, is_fixed, ros::TIME_MIN, bags_->begin - ros::Duration(0, 1));
    }
    bags_->played.addQuery(file, is_wanted, bags_->begin, bags_->end);
  }
  bags_->last = bags_->begin;
  bags_->place = bags_->before.begin();
}

BagReader::~BagReader() = default;

ros::Time BagReader::begin() const {
  return bags_->begin;
}

ros::Time BagReader::end() const {
  return bags_->end;
}

bool BagReader::next(BagRecord& record) {
  Bags& bags = *bags_;
  try {
    if (bags.is_before && bags.place == bags.before.end()) {
      bags.is_before = false;
      bags.place = bags.played.begin();
    }
    if (!bags.is_before && bags.place == bags.played.end()) return false;
    const rosbag::MessageInstance& found = *bags.place;
    record.time = bags.last = bags.is_before ? bags.begin : found.getTime();
    record.fixed = isOneOf(bags.selection.fixed_topics, found.getTopic());
    // A message that a program wrote has no sender.
    record.sender = printable(found.getCallerId().empty() ? found.getTopic() : found.getCallerId());
    const std::size_t size = found.size();
    if (size > kMostLength) throw std::runtime_error("a message of " + std::to_string(size) + " bytes");
    record.bytes.resize(size);
    ros::serialization::OStream stream(record.bytes.data(), static_cast<std::uint32_t>(size));
    found.write(stream);
    bags.complaints.require();
    ++bags.place;
  } catch (const std::exception& problem) {
    throw Error(joinedText(bags.selection.paths, ", "),
                damagedAt(secondsBetween(bags.begin, bags.last)) + problem.what(), kReindex);
  }
  return true;
}

std::string damagedAt(double seconds) {
  return "it is damaged " + fixedText(seconds, 3) + " s after the begin of what is played: ";
}

}  // namespace concave_distance
