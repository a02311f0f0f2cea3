#pragma once

// This folder answers a recorded bag, as the node would have answered the robot.
//
// It takes bag files, a scene and the options of the program distance_bag, and writes a row for every pair
// at every time at which a transform moves it. BagTransforms reads the messages of tf in the order of their
// recording, by a BagReader in a process of its own, which a damaged bag may end; BagMoments puts them into
// the node's TransformBuffer stamp by stamp; BagReplay runs the node's DistanceCycle at each, so that the
// rules of what is accepted and of a pair's time are the node's own; BagRows decides which answers are rows
// and BagReport writes them. It keeps a second of stamps that wait for slower publishers, and each pair's
// last row. Begin with bag_replay.h, then distance_bag.cpp. No master is needed, and nothing here knows a
// distance.
