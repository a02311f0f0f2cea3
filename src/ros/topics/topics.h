#pragma once

// This folder publishes what the node computes, for those who have subscribed.
//
// It takes the scene with its settings, the pairs of a cycle, and who has subscribed to what.
// It gives the demand of each pair (a distance, niches, forces, nothing), before a cycle; the messages
// of the cycle, after it. Nothing is computed or built for a topic that nobody listens to. It keeps the
// scene that is served with the topics of its pairs (SceneStore, ServedScene: readers take a snapshot, an
// edit makes a new one), the publishers with their counts of subscribers (WatchedTopic), the alerts that are
// raised. Begin with topic_publishers.h; nearest.h and diagnostics.h fill one message each.
