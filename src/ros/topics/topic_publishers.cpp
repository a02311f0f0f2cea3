#include "topic_publishers.h"

#include <concave_distance/Contacts.h>
#include <concave_distance/Distances.h>
#include <concave_distance/Nearest.h>
#include <concave_distance/Niches.h>
#include <std_msgs/Float64.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <utility>

#include "alerts.h"
#include "concave_distance/base/error.h"
#include "nearest.h"
#include "ros/markers/scene_markers.h"
#include "ros/messages/contact_conversions.h"
#include "ros/time_difference.h"
#include "scene/cloud_bodies.h"

namespace concave_distance {
namespace {

PairContactState toContactMessage(const PublishedPair& pair) {
  if (pair.tracked->solved() && pair.tracked->effects.contacts() != nullptr) {
    return toContacts(pair.heading, toDistance(pair.heading, pair.tracked->solution).status,
                      *pair.tracked->effects.contacts(), pair.tracked->input.a_from_b);
  }
  if (pair.tracked->box_bound) {  // proven apart, although not solved
    PairContacts apart;
    if (pair.tracked->settings.effects.normal_force) {
      apart.on_b_in_a = Wrench{};
    }
    return toContacts(pair.heading, pair.status, apart, pair.tracked->input.a_from_b);
  }
  return emptyContacts(pair.heading, pair.status);
}

// Fills what is said of the pairs that are not listed.
void countOthers(const PublishedPairs& pairs, const OtherPairs& others, Distances& message) {
  std::uint64_t beyond = others.beyond;
  double bound = others.lower_bound;
  for (const auto& pair : pairs) {
    if (!pair->demand().due || !pair->tracked->box_bound) continue;
    ++beyond;
    bound = std::min(bound, *pair->tracked->box_bound);
  }
  message.pairs_beyond_cutoff = static_cast<std::uint32_t>(beyond);
  message.pairs_missing = static_cast<std::uint32_t>(others.missing);
  message.pairs_cut = static_cast<std::uint32_t>(others.cut);
  message.has_others_lower_bound = static_cast<std::uint8_t>(beyond + others.cut > 0);
  message.others_lower_bound = message.has_others_lower_bound != 0 ? bound : kNotComputed;
}

bool isSolved(const PairNiches& message) {
  return message.nearest.has_distance != 0;
}
bool isSolved(const PairContactState& message) {
  return hasDistance(message.status);
}

// The oldest time of the pairs that carry a distance; `now` when none does.
template <typename Message>
std_msgs::Header commonHeader(const std::vector<Message>& messages, ros::Time now, const std::string& frame) {
  std_msgs::Header header;
  header.frame_id = frame;
  header.stamp = now;
  for (const Message& message : messages) {
    if (isSolved(message) && message.header.stamp < header.stamp) {
      header.stamp = message.header.stamp;
    }
  }
  return header;
}

}  // namespace

std::shared_ptr<const SceneKinematics> jointsOf(const ServedScene& served) {
  return served.joints.get([&] { return std::make_shared<const SceneKinematics>(*served.scene); });
}

TopicPublishers::TopicPublishers(const ros::NodeHandle& node, std::string reference_frame,
                                 std::optional<std::vector<std::string>> pair_topics,
                                 const ConstraintOptions& constraints)
    : node_(node),
      reference_frame_(std::move(reference_frame)),
      pair_topics_(node_, std::move(pair_topics)),
      nearest_(WatchedTopic::advertise<Nearest>(node_, "nearest", kQueueLength)),
      nearest_distance_(WatchedTopic::advertise<std_msgs::Float64>(node_, "nearest_distance", kQueueLength)),
      distances_(WatchedTopic::advertise<Distances>(node_, "distances", kQueueLength)),
      niches_(WatchedTopic::advertise<Niches>(node_, "niches", kQueueLength)),
      contacts_(WatchedTopic::advertise<Contacts>(node_, "contacts", kQueueLength)),
      markers_(WatchedTopic::advertise<visualization_msgs::MarkerArray>(node_, "markers", kQueueLength)),
      alerts_(WatchedTopic::advertise<Alert>(node_, "alerts", kAlertQueueLength)),
      constraints_(node_, reference_frame_, constraints),
      drawing_(std::make_unique<SceneMarkers>()) {}

TopicPublishers::~TopicPublishers() = default;

std::shared_ptr<const ServedScene> TopicPublishers::serve(Scene scene, const ServedScene* before,
                                                          const MarkerStyle& style, bool settings_changed) {
  pair_topics_.listPairs(scene);
  auto served = std::make_shared<ServedScene>();
  if (before != nullptr) {
    served->settings_revision = before->settings_revision + (settings_changed ? 1 : 0);
    served->revision = before->revision + 1;
  }
  served->scene = std::make_shared<const Scene>(std::move(scene));
  static const ServedGroups no_groups;
  served->groups = serveGroups(node_, *served->scene, before == nullptr ? no_groups : before->groups);
  served->marker_style = style;
  static const PairTopicList no_topics;
  served->topics = pair_topics_.topicsOf(*served->scene, before == nullptr ? nullptr : before->scene.get(),
                                         before == nullptr ? no_topics : before->topics);
  return served;
}

void TopicPublishers::takeJoints(const ServedScene& served) {
  std::shared_ptr<const SceneKinematics> joints;
  std::string problem;
  try {
    joints = jointsOf(served);
  } catch (const Error& error) {
    problem = error.what();
  }
  constraints_.setScene(std::move(joints), problem);
}

void TopicPublishers::readDemand(const ServedScene& served, const MarkerOptions& markers) {
  nearest_wanted_ = nearest_.isWatched() || nearest_distance_.isWatched();
  distances_wanted_ = distances_.isWatched();
  niches_wanted_ = niches_.isWatched();
  contacts_wanted_ = contacts_.isWatched();
  alerts_wanted_ = alerts_.isWatched();
  groups_wanted_ = readGroupDemand(served.groups);
  own_wanted_ = std::any_of(served.topics.begin(), served.topics.end(), [](const auto& own) {
    return own && (own->distance.isWatched() || own->niches.isWatched() || own->contacts.isWatched());
  });
  constraints_.readDemand();
  if (constraints_.isWanted()) takeJoints(served);
  const bool markers_watched = markers_.isWatched();
  if (!markers_watched) {
    drawing_->forget();
  }
  markers_wanted_ = markers.publish && markers_watched;
  contact_markers_wanted_ = markers_wanted_ && markers.contacts;
  are_markers_due_ = markers.due;
  // When markers are switched off, what is shown has to be deleted once more.
  markers_due_ = markers.due && (markers_wanted_ || !drawing_->empty());
}

PairDemand TopicPublishers::demandOf(const ServedScene& served, std::size_t place,
                                     const TrackedPair& tracked) const {
  static const PairTopics no_topics;
  const PairSettings& settings = tracked.origin->settings;
  const bool has_own = own_wanted_ && place < served.topics.size() && served.topics[place];
  const PairTopics& own = has_own ? *served.topics[place] : no_topics;
  const bool own_niches = own.niches.isWatched();
  const bool alert = alerts_wanted_ && settings.warning_distance;
  const bool contacts = (contacts_wanted_ || own.contacts.isWatched()) && settings.effects.any();
  PairDemand pair;
  pair.due = nearest_wanted_ || distances_wanted_ || niches_wanted_ || alert || own_niches || contacts ||
             own.distance.isWatched() || (groups_wanted_ && isWantedOfGroups(served.groups, tracked)) ||
             (markers_wanted_ && are_markers_due_);
  const bool rows = constraints_.concerns(tracked);
  pair.due = pair.due || rows;
  pair.watched = pair.due || markers_wanted_;
  pair.effects = contacts || (contact_markers_wanted_ && settings.effects.any());
  // A contact's id is its niche's.
  pair.niches = own_niches || rows || pair.effects;
  if (!pair.niches && detail::hasNiches(*tracked.body_a) && detail::hasNiches(*tracked.body_b)) {
    pair.niches_last = !niches_wanted_ && markers_wanted_ && are_markers_due_ &&
                       provesDistance(settings.tracker.accuracy) && drawing_->draws(tracked.origin->name);
    pair.niches = niches_wanted_ || pair.niches_last;
  }
  return pair;
}

bool TopicPublishers::isIdle() const {
  return !nearest_wanted_ && !distances_wanted_ && !niches_wanted_ && !contacts_wanted_ && !alerts_wanted_ &&
         !groups_wanted_ && !own_wanted_ && !markers_wanted_ && !markers_due_ && !constraints_.isWanted();
}

PublishReport TopicPublishers::publish(const ServedScene& served, const PublishedPairs& pairs,
                                       const OtherPairs& others, double marker_lifetime, ros::Time now) {
  PublishReport report;
  messages_.clear();
  const bool in_lists = distances_wanted_ || niches_wanted_ || markers_due_;
  for (std::size_t index = 0; index < pairs.size(); ++index) {
    const PublishedPair& pair = *pairs[index];
    const PairTopics* own = index < served.topics.size() ? served.topics[index].get() : nullptr;
    const bool own_distance = own != nullptr && own->distance.isWatched();
    const bool own_niches = own != nullptr && own->niches.isWatched();
    const bool is_listed = in_lists && !pair.tracked->box_bound;
    if (!pair.demand().due || !(is_listed || own_distance || own_niches)) {
      continue;
    }
    ++report.messages;
    PairNiches message = toNiches(pair);
    if (own_distance) {
      own->distance.publish(boost::make_shared<PairDistance>(message.nearest));
    }
    if (own_niches) {
      own->niches.publish(boost::make_shared<PairNiches>(message));
    }
    if (is_listed) {
      messages_.push_back(std::move(message));
    }
  }
  publishNearest(pairs, others, now);
  if (groups_wanted_) publishGroups(*served.scene, served.groups, pairs, others, reference_frame_, now);
  publishAlerts(pairs);
  publishContacts(served, pairs, now);
  if (markers_due_) {
    report.markers = static_cast<std::uint32_t>(publishMarkers(served, pairs, marker_lifetime, now));
  }
  publishLists(served, pairs, others, now);
  const ros::Time end = ros::Time::now();
  for (const auto& pair : pairs) {
    if (pair->demand().due && pair->tracked->solved() && !pair->tracked->repeated &&
        !pair->tracked->input.fixed) {
      report.latency.add(secondsBetween(pair->heading.stamp, end));
    }
  }
  return report;
}

void TopicPublishers::publishAlerts(const PublishedPairs& pairs) {
  const bool repeat = alerts_.takeNew();
  for (const auto& pair : pairs) {
    if (pair->tracked->warning_changed || (repeat && pair->tracked->warning.state() != WarningState::Clear)) {
      alerts_.publish(boost::make_shared<Alert>(toAlert(*pair)));
    }
  }
}

void TopicPublishers::publishRetired(const PublishedPairs& pairs) {
  for (const auto& pair : pairs) {
    alerts_.publish(boost::make_shared<Alert>(toAlert(*pair)));
  }
}

std::size_t TopicPublishers::publishMarkers(const ServedScene& served, const PublishedPairs& pairs,
                                            double lifetime, ros::Time now) {
  std_msgs::Header header;
  header.frame_id = reference_frame_;
  header.stamp = now;
  static const std::vector<PairNiches> no_niches;
  static const std::vector<PairContactState> no_contacts;
  const auto message = boost::make_shared<visualization_msgs::MarkerArray>(
      drawing_->draw(*served.scene, served.marker_style, pairs, markers_wanted_ ? messages_ : no_niches,
                     contact_markers_wanted_ ? contact_messages_ : no_contacts, header, lifetime));
  markers_.publish(message);
  return message->markers.size();
}

void TopicPublishers::publishContacts(const ServedScene& served, const PublishedPairs& pairs, ros::Time now) {
  contact_messages_.clear();
  for (std::size_t index = 0; index < pairs.size(); ++index) {
    if (!pairs[index]->demand().due || !pairs[index]->demand().effects) {
      continue;
    }
    contact_messages_.push_back(toContactMessage(*pairs[index]));
    const PairTopics* own = index < served.topics.size() ? served.topics[index].get() : nullptr;
    if (own != nullptr && own->contacts.isWatched()) {
      own->contacts.publish(boost::make_shared<PairContactState>(contact_messages_.back()));
    }
  }
  if (contacts_wanted_) {
    auto message = boost::make_shared<Contacts>();
    message->header = commonHeader(contact_messages_, now, reference_frame_);
    message->pairs = contact_messages_;
    contacts_.publish(message);
  }
}

void TopicPublishers::publishNearest(const PublishedPairs& pairs, const OtherPairs& others, ros::Time now) {
  if (!nearest_wanted_) {
    return;
  }
  const auto message = boost::make_shared<Nearest>(nearestOf(pairs, others, reference_frame_, now));
  if (message->has_number != 0) {
    const auto number = boost::make_shared<std_msgs::Float64>();
    number->data = message->number;
    nearest_distance_.publish(number);
  }
  nearest_.publish(message);
}

void TopicPublishers::publishLists(const ServedScene& served, const PublishedPairs& pairs,
                                   const OtherPairs& others, ros::Time now) {
  if (distances_wanted_) {
    auto message = boost::make_shared<Distances>();
    message->scene_revision = served.revision;
    countOthers(pairs, others, *message);
    message->header = commonHeader(messages_, now, reference_frame_);
    message->pairs.reserve(messages_.size());
    for (const PairNiches& pair : messages_) {
      message->pairs.push_back(pair.nearest);
    }
    distances_.publish(message);
  }
  if (niches_wanted_) {
    auto message = boost::make_shared<Niches>();
    message->header = commonHeader(messages_, now, reference_frame_);
    message->pairs = std::move(messages_);
    message->pairs_put_off = static_cast<std::uint32_t>(
        std::count_if(pairs.begin(), pairs.end(), [](const auto& pair) { return pair->tracked->put_off; }));
    niches_.publish(message);
  }
}

}  // namespace concave_distance
