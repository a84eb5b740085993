// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_REPORT_HPP
#define RSACKERMANN_SAMPLES_REPORT_HPP

#include "opencv2/rsackermann.hpp"
#include <string>

namespace rsackermann_samples {

//! The report on a frame.
struct FrameReport
{
    FrameReport();

    std::string input, error; //!< error: why the frame isn't corrected; empty: it is
    int frame, frames;        //!< number of a video's frame, from 0, and how many there are; -1: the input is an image
    double time;              //!< seconds; NaN: unknown
    double pixelAspect;       //!< width of a pixel over its height, as the video says
    cv::rsackermann::RollingShutterCamera camera;
    double roll, pitch; //!< degrees, with which the camera was mounted: of the log or of the camera
    cv::rsackermann::AckermannMotion motion;
    cv::rsackermann::MotionPrior prior; //!< the given values
    int segments;
    bool isLogged;    //!< whether the log knows the frame
    bool isGyroWrong; //!< by the frames up to this one
    bool isGyroUsed;
    bool isDepthGiven, isDepthUsed;
    double change;     //!< of the image of a sequence, see ImageChange; NaN: none
    double meanShift;  //!< pixels, mean distance between the maps and those that only undo the lens
    cv::Vec4d timings; //!< milliseconds of detection, estimation, maps and remapping
};

//! A line of JSON; unknown values are null.
std::string reportLine(const FrameReport& frame);

//! Words on the given values that the image contradicts; none if there are none. @param wall given distance, or 0.
std::string contradiction(const FrameReport& frame, double wall);

//! The same for an input that isn't corrected, or not to its end.
std::string failureLine(const std::string& input, const std::string& error);

//! A file's name as it stands in a line: if it isn't valid UTF-8 each byte that isn't ASCII becomes U+FFFD and two
//! hexadecimal digits.
std::string nameInReport(const std::string& input);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_REPORT_HPP
