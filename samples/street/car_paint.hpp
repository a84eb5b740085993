// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_CAR_PAINT_HPP
#define RSACKERMANN_SAMPLES_CAR_PAINT_HPP

#include "opencv2/core.hpp"

namespace street {

/** Colour (BGR, 0..255) of a parked car, a box with windows and wheels painted on.
    @param place on the box, from its corner: along the car, from the side at the street to the houses, up; metres.
    @param size of the box.
    @param body colour of the car. */
cv::Vec3f sampleCar(const cv::Vec3d& place, const cv::Vec3d& size, const cv::Vec3f& body);

} // namespace street

#endif // RSACKERMANN_SAMPLES_CAR_PAINT_HPP
