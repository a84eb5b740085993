// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_PERF_DRIVE_HPP
#define RSACKERMANN_PERF_DRIVE_HPP

#include "opencv2/rsackermann.hpp"
#include <string>
#include <vector>

namespace experiments {

//! A frame of a car's camera, with what a log says of it.
struct DriveFrame
{
    std::string file;
    cv::rsackermann::RollingShutterCamera camera;
    double secondsToNext;  //!< time between this frame's and the next one's reference row
    double speed, yawRate; //!< of the log: m/s, rad/s
};

//! The frames that a folder's frames.csv lists; throws InputError.
std::vector<DriveFrame> readDrive(const std::string& folder);

//! What a log says of a frame, to 1 deg/s and 2 km/h; @p given: 1 for its yaw rate, 2 for its speed, 3 for both.
cv::rsackermann::MotionPrior priorOf(const DriveFrame& frame, int given);

/** Where the optical flow to the next frame says that a global shutter would have seen the pixels of a frame.

A raw pixel q that is read at the time t after the reference row and moves by v each second belongs at q - v t. The flow
is taken where forward and backward flow agree and the image has texture; the bonnet is left out.
*/
class FlowTruth
{
public:
    FlowTruth(const DriveFrame& frame, const cv::Mat& image, const cv::Mat& next);

    //! Mean displacement in pixels of the raw image and of one that is corrected by the maps, over the same pixels.
    void measure(const cv::Mat& columns, const cv::Mat& rows, double& raw, double& left) const;

private:
    bool displacement(const cv::Point2f& raw, const cv::Point2f& corrected, double& distance) const;

    cv::Size size;
    double lineDelay, reference;
    cv::Mat velocity; // pixels per second, one of STEP x STEP pixels
    cv::Mat known;
};

} // namespace experiments

#endif // RSACKERMANN_PERF_DRIVE_HPP
