#pragma once

// This folder makes messages from results, with the names and frames that go with them.
//
// It takes a tracked pair of scene/ with its solution and its effects, and where its bodies are.
// It gives the fields of PairNiches, PairDistance, PairContactState and PairStatus, all in the
// reference frame, in metres, newtons and seconds; what was not computed is NaN and says so. It keeps in
// a PublishedPair the names, frames, stamp and status of a pair, beside the numbers that the tracker keeps;
// the conversions themselves are functions without memory. Begin with published_pair.h, then conversions.h
// (distances and niches) and contact_conversions.h (forces).
