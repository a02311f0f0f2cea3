#include "distance_server.h"

#include <ros/console.h>
#include <tbb/task_arena.h>

#include <optional>
#include <thread>
#include <utility>

#include "reconfiguration.h"
#include "ros/callback_guard.h"
#include "ros/tf/frame_report.h"
#include "ros/topics/diagnostics.h"
#include "scene_loader.h"

namespace concave_distance {
namespace {

constexpr double kLoadPeriod = 0.1;          // s, between two looks for the robot description
constexpr double kHousekeepingPeriod = 0.2;  // s
constexpr double kDescriptionPeriod = 2.0;   // s, between two looks for changed robot descriptions
constexpr const char* kRemedies =
    "fewer pairs (an SRDF, the scene file's pairs, ~skip_overlapping_pairs), a shorter ~cutoff, a lower "
    "~rate, more ~threads, subscribers of distances instead of niches, ~relative_tolerance";
constexpr double kProgressPeriod = 2.0;  // s, between two messages about loading
constexpr double kMessagePeriod = 5.0;   // s, between two messages about what is missing

NodeParameters readParameters(const ros::NodeHandle& node) {
  XmlRpc::XmlRpcValue values;
  node.getParam("", values);
  std::vector<std::string> unknown;
  NodeParameters parameters = parseNodeParameters(values, unknown);
  for (const std::string& name : unknown) {
    ROS_WARN_STREAM("The parameter '" << node.resolveName(name)
                                      << "' is not known to this node: a spelling mistake?");
  }
  const std::uint32_t cores = std::thread::hardware_concurrency();
  if (cores != 0 && parameters.threads > cores) {
    ROS_WARN("~threads is %u, this machine has %u cores: no more threads than cores are used.",
             parameters.threads, cores);
  }
  return parameters;
}

bool isDue(ros::WallTime& last, double period) {
  const ros::WallTime now = ros::WallTime::now();
  if (!last.isZero() && (now - last).toSec() < period) {
    return false;
  }
  last = now;
  return true;
}

}  // namespace

DistanceServer::DistanceServer(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                               std::string name, FatalCallback on_fatal)
    : private_node_(private_node),
      parameters_(readParameters(private_node)),
      cutoff_is_automatic_(parameters_.automatic_cutoff),
      on_fatal_(std::move(on_fatal)),
      transforms_({parameters_.tf_cache, parameters_.tf_future_tolerance}),
      receiver_(node, transforms_),
      publishers_(private_node, parameters_.reference_frame, parameters_.pair_topics,
                  parameters_.constraints),
      keeper_(publishers_, parameters_.pair, parameters_.marker),
      service_queues_(private_node, parameters_.limits),
      queries_(
          service_queues_, keeper_,
          {&transforms_, parameters_.reference_frame, parameters_.transform_timeout, parameters_.stale_after},
          parameters_.limits, parameters_.threads),
      clearances_(
          service_queues_, keeper_,
          {&transforms_, parameters_.reference_frame, parameters_.transform_timeout, parameters_.stale_after},
          parameters_.limits),
      scene_services_(service_queues_, keeper_, restarts_, parameters_.reference_frame),
      operation_services_(service_queues_, keeper_, transforms_, parameters_.reference_frame, rosPackagePath,
                          parameters_.mesh_access),
      descriptions_(private_node_),
      state_services_(service_queues_, keeper_, transforms_, parameters_.reference_frame,
                      parameters_.save_folder,
                      {[this](const std::shared_ptr<BodyPool>& pool) { return loadAgain(pool); },
                       [this](const Scene& loaded) { onReloaded(loaded); }}),
      moves_(service_queues_, keeper_, transforms_, parameters_.reference_frame),
      clouds_(node, keeper_, transforms_, parameters_.transform_timeout),
      runner_(transforms_, keeper_, publishers_, restarts_,
              {parameters_.reference_frame, parameters_.stale_after, parameters_.threads,
               &service_queues_.gate().stopped(), true},
              parameters_.cycle_budget),
      // The updater would read ~diagnostic_period unchecked; in this namespace it finds none.
      updater_(node, ros::NodeHandle(private_node, "diagnostic_updater"), std::move(name)),
      body_publisher_(private_node_) {
  setUpDiagnostics();
  runner_.setRates(parameters_.rate, parameters_.marker_rate);
  runner_.setMarkers(parameters_.publish_markers, parameters_.publish_contact_markers);
  runner_.start(parameters_.rate);
  config_ = toConfig(parameters_);
  // The reconfigure server begins with what it finds, and overlooks a number where it expects a text.
  config_.__toServer__(private_node_);
  reconfigure_ =
      std::make_unique<dynamic_reconfigure::Server<ConcaveDistanceConfig>>(reconfigure_mutex_, private_node_);
  reconfigure_->setConfigMin(lowestConfig());
  reconfigure_->setConfigMax(highestConfig());
  reconfigure_->setCallback(
      [this](ConcaveDistanceConfig& config, std::uint32_t level) { onReconfigure(config, level); });
  forgetAutomaticCutoff();
  load_timer_ = startTimer(kLoadPeriod, "Loading the scene", &DistanceServer::tryToLoad);
  description_timer_ = startTimer(kDescriptionPeriod, "Looking for changed descriptions",
                                  &DistanceServer::reportChangedDescription);
  housekeeping_timer_ = startTimer(kHousekeepingPeriod, "Housekeeping", &DistanceServer::doHousekeeping);
}

DistanceServer::~DistanceServer() {
  service_queues_.gate().stop();
  service_queues_.motionGate().stop();
}

ros::WallTimer DistanceServer::startTimer(double period, const char* name, void (DistanceServer::*act)()) {
  return private_node_.createWallTimer(
      ros::WallDuration(period),
      [this, name, act](const ros::WallTimerEvent& /*event*/) { guarded(name, [&] { (this->*act)(); }); });
}

void DistanceServer::tryToLoad() {
  if (loader_.isRunning()) {
    followLoading();
    return;
  }
  SceneRequest request;
  try {
    request = requestScene(parameters_, private_node_);
  } catch (const Error& problem) {
    giveUpLoading(problem);
    return;
  }
  if (request.waiting_for.empty()) {
    last_load_message_ = ros::WallTime::now();
    {
      const boost::recursive_mutex::scoped_lock lock(reconfigure_mutex_);
      config_of_loading_ = config_;
    }
    loader_.start(parameters_, std::move(request));
    followLoading();
    return;
  }
  keeper_.setWaitingFor(request.waiting_for);
  if (isDue(last_load_message_, kMessagePeriod)) {
    ROS_WARN_STREAM("Waiting: " << request.waiting_for);
  }
}

void DistanceServer::giveUpLoading(const Error& problem) {
  load_timer_.stop();
  keeper_.setWaitingFor(std::string("the scene cannot be loaded: ") + problem.what());
  on_fatal_(problem);
}

void DistanceServer::followLoading() {
  std::optional<SceneLoader::Outcome> outcome = loader_.take();
  if (!outcome) {
    keeper_.setWaitingFor("loading: " + loader_.progress());
    if (isDue(last_load_message_, kProgressPeriod)) {
      ROS_INFO_STREAM("Loading the scene: " << loader_.progress());
    }
    return;
  }
  if (outcome->error) {
    giveUpLoading(*outcome->error);
    return;
  }
  load_timer_.stop();
  logScene(*outcome->scene, loader_.seconds());
  // Parameters that are set from now on change the new scene's pairs.
  const boost::recursive_mutex::scoped_lock lock(reconfigure_mutex_);
  if (outcome->scene->automatic_cutoff && config_.cutoff == config_of_loading_.cutoff) {
    adoptCutoff(*outcome->scene->automatic_cutoff);
    config_of_loading_.cutoff = config_.cutoff;
  }
  applyChanges(config_of_loading_, config_, *outcome->scene);
  descriptions_.remember(loader_.request());
  keeper_.replace(std::move(*outcome->scene));
  keeper_.setWaitingFor("");
}

Scene DistanceServer::loadAgain(const std::shared_ptr<BodyPool>& pool) {
  reload_request_ = requestScene(parameters_, private_node_);
  if (!reload_request_.waiting_for.empty())
    throw Error("reload", reload_request_.waiting_for, "set it and call again; nothing was changed");
  LoadProgress progress;
  progress.stopped_with = &service_queues_.gate().stopped();
  std::optional<Scene> scene;
  // On this thread alone: a worker that reads meshes would be missing in the cycle.
  tbb::task_arena(1).execute([&] { scene = loadScene(parameters_, reload_request_, progress, pool); });
  const boost::recursive_mutex::scoped_lock lock(reconfigure_mutex_);
  applyChanges(config_of_loading_, config_, *scene);
  return std::move(*scene);
}

void DistanceServer::onReloaded(const Scene& loaded) {
  descriptions_.remember(reload_request_);
  if (!loaded.automatic_cutoff || !cutoff_is_automatic_) return;
  const boost::recursive_mutex::scoped_lock lock(reconfigure_mutex_);
  adoptCutoff(*loaded.automatic_cutoff);
  config_of_loading_.cutoff = config_.cutoff;
}

void DistanceServer::reportChangedDescription() {
  const std::string news = descriptions_.findNews();
  if (news.empty()) return;
  ROS_WARN_STREAM(
      "The parameter '" << news << "' has changed since the scene was loaded, and the distances are those "
                        << "of the robot as it was: call the service " << private_node_.resolveName("reload")
                        << " to take the new one.");
}

// The caller holds the mutex of the settings.
void DistanceServer::adoptCutoff(double cutoff) {
  setCutoff(config_, cutoff);
  reconfigure_->updateConfig(config_);
  forgetAutomaticCutoff();
}

// The reconfigure server writes every value to the parameter server, and the next start would take this one
// for the user's setting.
void DistanceServer::forgetAutomaticCutoff() {
  if (cutoff_is_automatic_) private_node_.deleteParam("cutoff");
  settings_were_written_ = false;
}

void DistanceServer::setUpDiagnostics() {
  updater_.setHardwareID("none");
  updater_.add("cycle", [this](diagnostic_updater::DiagnosticStatusWrapper& status) {
    window_ = runner_.statistics().take(ros::WallTime::now().toSec());
    describeCycle(window_, runner_.rate(), status);
  });
  updater_.add("pairs", [this](diagnostic_updater::DiagnosticStatusWrapper& status) {
    describePairs(window_, status);
  });
  updater_.add("effects", [this](diagnostic_updater::DiagnosticStatusWrapper& status) {
    describeEffects(window_, status);
  });
  updater_.add("scene", [this](diagnostic_updater::DiagnosticStatusWrapper& status) {
    describeScene(*keeper_.served()->scene, keeper_.waitingFor(), descriptions_.changed(), status);
  });
  updater_.add("transforms", [this](diagnostic_updater::DiagnosticStatusWrapper& status) {
    describeTransforms(receiver_.take(), status);
  });
  updater_.add("moves", [this](diagnostic_updater::DiagnosticStatusWrapper& status) {
    describeMoves(moves_.take(), status);
  });
  updater_.add("clouds", [this](diagnostic_updater::DiagnosticStatusWrapper& status) {
    describeClouds(clouds_.take(), status);
  });
  diagnostics_timer_ = startTimer(parameters_.diagnostic_period, "Publishing diagnostics",
                                  &DistanceServer::publishDiagnostics);
}

void DistanceServer::publishDiagnostics() {
  updater_.force_update();
}

void DistanceServer::doHousekeeping() {
  if (settings_were_written_) {
    const boost::recursive_mutex::scoped_lock lock(reconfigure_mutex_);
    forgetAutomaticCutoff();
  }
  reportMissingClock();
  clouds_.follow(*keeper_.served()->scene);
  if (parameters_.show_bodies) body_publisher_.publish(keeper_.served()->scene, parameters_.show_collision);
  reportLateness();
  if (keeper_.waitingFor().empty() && isDue(last_frame_message_, kMessagePeriod)) {
    reportMissingFrames();
  }
}

void DistanceServer::reportLateness() {
  const std::shared_ptr<const Scene> scene = keeper_.served()->scene;
  const std::size_t pairs = scene->pairs.size() + countPairsByRule(*scene);
  if (pairs == 0) {
    lateness_.restart();
    return;
  }
  LatenessSample sample;
  sample.wall = ros::WallTime::now().toSec();
  sample.ros_time = ros::Time::now().toSec();
  sample.cycles = runner_.statistics().totalCycles();
  sample.late = runner_.statistics().totalLate();
  sample.wanted_rate = runner_.rate();
  const std::optional<LatenessMonitor::News> news = lateness_.update(sample);
  if (!news) {
    return;
  }
  if (news->is_warning) {
    ROS_WARN_STREAM(news->text << ". " << pairs << " pairs are in the scene; what helps: " << kRemedies);
  } else {
    ROS_INFO_STREAM(news->text);
  }
}

void DistanceServer::reportMissingClock() {
  const std::string missing = missingClock();
  if (!missing.empty() && isDue(last_clock_message_, kMessagePeriod)) {
    ROS_WARN_STREAM(missing);
  }
}

void DistanceServer::reportMissingFrames() {
  const std::shared_ptr<const tf2::BufferCore> buffer = transforms_.current();
  const std::shared_ptr<const ServedScene> served = keeper_.served();  // kept alive during edits
  const std::string missing = describeMissingFrames(*buffer, *served->scene, parameters_.reference_frame);
  if (!missing.empty()) {
    ROS_WARN_STREAM(missing);
  }
}

void DistanceServer::onReconfigure(ConcaveDistanceConfig& config, std::uint32_t /*level*/) {
  const ConcaveDistanceConfig before = config_;
  settings_were_written_ = true;  // as soon as this returns
  try {
    checkConfig(config);
    cycleBudget(parameters_.cycle_budget, config.rate);
    if (concernsPairs(before, config)) {
      keeper_.changeSettings([&](PairSettings& settings) { applyRequest(before, config, settings); });
    }
  } catch (const std::exception& problem) {
    ROS_ERROR_STREAM("Reconfiguration refused, nothing was changed: " << problem.what());
    config = before;  // the client's answer
    return;
  }
  runner_.setRates(config.rate, config.marker_rate);
  runner_.setMarkers(config.publish_markers, config.publish_contact_markers);
  config_ = config;
  cutoff_is_automatic_ = cutoff_is_automatic_ && config.cutoff == before.cutoff;
}

}  // namespace concave_distance
