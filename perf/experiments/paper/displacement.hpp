// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_PERF_DISPLACEMENT_HPP
#define RSACKERMANN_PERF_DISPLACEMENT_HPP

#include "street_model.hpp"

namespace paper {

//! Where the pixels of a rolling-shutter image belong, for one of 4 x 4 of them.
class DenseTruth
{
public:
    explicit DenseTruth(const street::StreetRenderer& renderer, const cv::Size& size);

    //! Mean distance in pixels of the pixels from where they belong.
    double raw() const { return raw_; }
    //! The same after the correction by a motion; by the camera as the estimator was given it.
    double left(const cv::rsackermann::RollingShutterCamera& camera,
                const cv::rsackermann::AckermannMotion& motion) const;

private:
    cv::Mat pixels_, places_; // N x 1, CV_32FC2
    double raw_;
};

/** Displacement as it can be measured without knowing the motion: square patches at corners of the global-shutter image
are searched in the other image.
@param mask of the pixels of the other image that have a source; may be empty.
@return mean distance of the patches that are found, in pixels; NaN if there are none. */
double patchDisplacement(const cv::Mat& global, const cv::Mat& image, const cv::Mat& mask);

} // namespace paper

#endif // RSACKERMANN_PERF_DISPLACEMENT_HPP
