// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SEQUENCE_COPIES_HPP
#define OPENCV_RSACKERMANN_SRC_SEQUENCE_COPIES_HPP

#include "scene_fit.hpp"

// Images that nearly repeat the one before, as converters of frame rates add them (doc/theory.md, "Sequence"). No car
// stops or starts at once.

namespace cv { namespace rsackermann {

/** Whether nearly the same image comes again: a car that was fast a moment ago, and isn't given to be slow, doesn't
stand.
@param passed seconds since the one before. */
bool showsCopy(const SequenceFit& fit, const std::vector<TrackedBearing>& bearings, double passed,
               const MotionPrior& prior);

//! Whether most of what was tracked stands still.
bool isStill(const std::vector<TrackedBearing>& bearings);

//! Whether next to nothing moves since the neighbour that was taken some seconds before.
bool isStillSince(const std::vector<TrackedBearing>& bearings, double seconds);

//! Whether next to nothing moves between the frame and one of its neighbours, and most to the other.
bool stopsOrStartsAtOnce(const std::vector<TrackedBearing>& bearings);

/** Whether the images before may be copies of one that was taken earlier.
@param passed seconds since the last one.
@param since seconds from the first one to the last one, between which nothing moved. */
bool mayFollowCopies(const std::vector<TrackedBearing>& bearings, double passed, double since);

//! Whether a car that stood some seconds ago can't move as it does.
bool movesTooSoon(const SequenceFit& fit, double seconds);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SEQUENCE_COPIES_HPP
