// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_VIDEO_TIMING_HPP
#define RSACKERMANN_SAMPLES_VIDEO_TIMING_HPP

#include "frame_index.hpp"
#include "opencv2/videoio.hpp"

namespace rsackermann_samples {

/** Times of a video's frames from its container's index, else as OpenCV reports them; if it doesn't they have
equal distances. */
class FrameClock
{
public:
    explicit FrameClock(const cv::VideoCapture& capture, const FrameIndex& index = FrameIndex());

    //! Seconds of the frame that was grabbed last.
    double timeOfFrame(const cv::VideoCapture& capture);
    //! The rate that the container announces, frames per second.
    double announcedRate() const { return 1 / interval_; }

private:
    double indexedTime(double reported);

    double interval_, time_;
    std::vector<double> index_; // empty if it contradicts OpenCV
    size_t next_;               // in the index
};

/** The number of frames per second with which all frames of a video take as long as in the video: the mean, if the rate
varies. Goes through the whole video. */
double meanRate(const std::string& path);

//! The number of frames that a video has; goes through the whole video.
int countFrames(const std::string& path);

//! Width of a video's pixels over their height; 1 if it doesn't say.
double pixelAspect(const cv::VideoCapture& capture);

//! Opens a video so that its frames have the sensor's rows as rows; throws InputError.
cv::VideoCapture openVideo(const std::string& path);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_VIDEO_TIMING_HPP
