#include "cloud_receiver.h"

#include <ros/console.h>

#include <algorithm>
#include <exception>
#include <new>
#include <utility>

#include "base/give_way.h"
#include "base/number_text.h"
#include "base/short_text.h"
#include "concave_distance/base/error.h"
#include "ros/callback_guard.h"
#include "ros/seconds_text.h"
#include "scene/cloud_bodies.h"

namespace concave_distance {
namespace {

constexpr std::uint32_t kCloudQueueLength = 1;
constexpr std::chrono::seconds kSubscribeAgain{2};  // at the earliest

// Ends the use of a message whose cloud is not in the scene any more.
struct Gone {};

std::string tooLate(double seconds, const CloudSettings& settings) {
  TextStream text;
  text << "its body was made " << secondsText(seconds) << " s after the message, stale_after is "
       << settings.stale_after
       << " s: its pairs have no distance (use larger voxels, a shorter range or a longer stale_after)";
  return text.str();
}

}  // namespace

CloudReceiver::CloudReceiver(ros::NodeHandle node, const SceneBody& body, SceneStore& keeper,
                             const TransformBuffer& transforms, double transform_timeout)
    : node_(std::move(node)),
      name_(body.name),
      frame_(body.frame),
      settings_(body.cloud->settings),
      keeper_(keeper),
      transforms_(transforms),
      transform_timeout_(transform_timeout) {
  report_.name = name_;
  report_.topic = node_.resolveName(settings_->topic);
  thread_ = std::thread([this] { work(); });
}

CloudReceiver::~CloudReceiver() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_ending_ = true;
  }
  arrived_.notify_all();
  thread_.join();
}

bool CloudReceiver::isOf(const SceneBody& body) const {
  return body.cloud && body.name == name_ && body.frame == frame_ && *body.cloud->settings == *settings_;
}

CloudReport CloudReceiver::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  CloudReport report = report_;
  report_.refused_lately = 0;
  return report;
}

void CloudReceiver::receive(const topic_tools::ShapeShifter::ConstPtr& message) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (newest_.message) ++report_.passed_over;
    newest_ = {message, Clock::now()};
  }
  arrived_.notify_all();
}

// roscpp connects to publishers of the first one's type alone, until nobody subscribes.
void CloudReceiver::subscribe() {
  subscribed_ = Clock::now();
  subscriber_.shutdown();
  subscriber_ = node_.subscribe<topic_tools::ShapeShifter>(
      settings_->topic, kCloudQueueLength,
      [this](const topic_tools::ShapeShifter::ConstPtr& message) { receive(message); }, ros::VoidConstPtr(),
      ros::TransportHints().tcpNoDelay());
}

// After another type anew until a known one comes: a publisher that only connects fixes the type too.
void CloudReceiver::waitForMessage(std::unique_lock<std::mutex>& lock) {
  const auto has_come = [&] { return is_ending_ || newest_.message; };
  while (has_other_type_ && !is_ending_) {
    const Clock::time_point again = subscribed_ + kSubscribeAgain;
    if (Clock::now() < again && arrived_.wait_until(lock, again, has_come)) return;
    lock.unlock();
    guarded("A cloud", [&] { subscribe(); });
    lock.lock();
  }
  arrived_.wait(lock, has_come);
}

void CloudReceiver::work() {
  giveWay();
  guarded("A cloud", [&] { subscribe(); });
  const auto period =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / settings_->rate));
  Clock::time_point due = Clock::now();
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    waitForMessage(lock);
    while (!is_ending_ && Clock::now() < due) arrived_.wait_until(lock, due);
    if (is_ending_) return;
    const Arrival arrival = std::exchange(newest_, {});
    due = std::max(due + period, Clock::now());
    lock.unlock();
    guarded("A cloud", [&] { use(arrival); });
    lock.lock();
  }
}

void CloudReceiver::use(const Arrival& arrival) {
  std::string problem;
  has_other_type_ = false;
  try {
    const CloudReading reading = readCloud(*arrival.message, *settings_);
    const ros::Time stamp = reading.stamp.isZero() ? ros::Time::now() : reading.stamp;
    const std::shared_ptr<const Scene> scene = keeper_.served()->scene;
    const std::optional<std::size_t> place = scene->findBody(name_);
    if (!place || !isOf(scene->bodies[*place])) return;
    const SceneBody& body = scene->bodies[*place];
    const CloudVoxels made = makeVoxels(reading, *scene, body, transforms_, transform_timeout_);
    CloudReport report;
    report.remark = made.remark;
    report.stamp = stamp;
    report.points = reading.points_in;
    report.left_out = made.left_out;
    report.voxels = made.voxels.cells().size();
    serve(body, made, stamp);
    report.seconds = std::chrono::duration<double>(Clock::now() - arrival.time).count();
    // The seconds of what is late differ from cloud to cloud and must not make each a subject of its own.
    std::string subject = report.remark;
    if (report.seconds >= settings_->stale_after) {
      detail::addRemark(subject, "late");
      detail::addRemark(report.remark, tooLate(report.seconds, *settings_));
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!report.remark.empty() && throttle_.isDue(subject))
      ROS_WARN_STREAM("cloud '" << name_ << "': " << report.remark);
    ++report_.taken;
    report_.remark = report.remark;
    report_.stamp = report.stamp;
    report_.points = report.points;
    report_.left_out = report.left_out;
    report_.voxels = report.voxels;
    report_.seconds = report.seconds;
    return;
  } catch (const Gone&) {
    return;
  } catch (const OtherType& error) {
    problem = error.what();
    has_other_type_ = true;
  } catch (const Error& error) {
    problem = error.what();
  } catch (const std::bad_alloc&) {
    problem = "there is not enough memory for this cloud (thin it, or use larger voxels)";
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  ++report_.refused;
  ++report_.refused_lately;
  report_.last_refusal = shortText(problem);
  if (throttle_.isDue("refused"))
    ROS_WARN_STREAM("cloud '" << name_ << "' is refused: " << report_.last_refusal);
}

void CloudReceiver::serve(const SceneBody& body, const CloudVoxels& made, ros::Time stamp) {
  CloudState state;
  state.settings = settings_;
  state.stamp = static_cast<std::int64_t>(stamp.toNSec());
  state.voxel_size = made.voxels.size();
  const CloudState& before = *body.cloud;
  const bool is_same = before.cells && before.voxel_size == state.voxel_size &&
                       before.cells->size() == made.voxels.cells().size() &&
                       std::all_of(before.cells->begin(), before.cells->end(),
                                   [&](const VoxelCell& cell) { return made.voxels.contains(cell); });
  std::shared_ptr<const BodyMesh> mesh;
  if (is_same) {
    state.cells = before.cells;
  } else {
    state.cells = std::make_shared<const std::vector<VoxelCell>>(made.voxels.cells());
    if (state.hasVoxels()) mesh = detail::makeCloudMesh(name_, made.voxels);
  }
  keeper_.edit([&](Scene& scene) {
    const std::optional<std::size_t> place = scene.findBody(name_);
    if (!place || !isOf(scene.bodies[*place])) throw Gone();
    // A reload may have replaced the cells that were compared.
    if (is_same && scene.bodies[*place].cloud->cells != before.cells) throw Gone();
    detail::takeCloud(scene.bodies.edit(*place), state, mesh, made.frame_from_voxels);
  });
}

}  // namespace concave_distance
