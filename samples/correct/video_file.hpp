// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_VIDEO_FILE_HPP
#define RSACKERMANN_SAMPLES_VIDEO_FILE_HPP

#include "opencv2/videoio.hpp"
#include "output/atomic_file.hpp"

namespace rsackermann_samples {

/** A video that appears complete or not at all, in the format of its name's extension, with all columns and rows: sizes
that the format can't keep are refused. */
class VideoFile
{
public:
    VideoFile(const std::string& path, double framesPerSecond, const cv::Size& size);

    void add(const cv::Mat& frame);
    //! Ends the video and reads it again, as writers of videos don't report errors; throws InputError.
    void close();
    //! Gives the file its final name.
    void commit() { file_.commit(); }

private:
    std::string path_;
    cv::Size size_;
    double framesPerSecond_;
    bool isOdd_; // the size
    int frames_;
    AtomicFile file_;
    cv::VideoWriter writer_; // closed before the file is removed
};

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_VIDEO_FILE_HPP
