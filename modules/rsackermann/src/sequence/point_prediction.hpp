// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SEQUENCE_POINT_PREDICTION_HPP
#define OPENCV_RSACKERMANN_SRC_SEQUENCE_POINT_PREDICTION_HPP

#include "sequence_filter.hpp"

namespace cv { namespace rsackermann {

//! Where points are expected in other images, by motion and planes of a sequence's state. The camera is the filter's.
//! @param kept the filter at the frame that is kept, if there is one.
FramePrediction predictPoints(const RollingShutterCamera& camera, const AckermannEstimator::Params& params,
                              const SequenceFilter& filter, const SequenceFilter* kept = 0);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SEQUENCE_POINT_PREDICTION_HPP
