// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_DRIVE_READER_HPP
#define RSACKERMANN_SAMPLES_DRIVE_READER_HPP

#include "drive_log.hpp"
#include "inputs.hpp"
#include "opencv2/core.hpp"
#include <functional>

namespace rsackermann_samples {

//! A frame of a drive, with the facts from the log.
struct DriveFrame
{
    cv::Mat image;
    FrameFacts facts;        //!< the time is known
    bool isTimeGiven = true; //!< and not only 1/30 s after the image before
};

/** Reads all frames of a drive in their order; each video is a drive of its own. An image without a time has that of
missingTimes(), else it follows after 1/30 s.
@param use is called with each frame and the share of the work that is done.
@param fail is called with an input that can't be read, and why.
Throws Interrupted if a signal asks the program to end, and UsageError if use() does. */
void readDrive(const InputList& list, const DriveLog& log, const std::function<void(const DriveFrame&, double)>& use,
               const std::function<void(const std::string&, const std::string&)>& fail);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_DRIVE_READER_HPP
