// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_PAGE_PICTURES_HPP
#define RSACKERMANN_SAMPLES_PAGE_PICTURES_HPP

#include "opencv2/core.hpp"
#include <memory>

namespace cv {
class VideoCapture; // not every OpenCV has it
}

namespace rsackermann_samples {

//! Makes small pictures of images and of frames of videos, quickly if those of a video come in their order.
class PictureMaker
{
public:
    /** The bytes of a JPEG; throws InputError.
    @param frame number of a video's frame; -1: the file is an image.
    @param width most pixels of its width. */
    std::vector<uchar> make(const std::string& path, int frame, int width);

private:
    std::shared_ptr<cv::VideoCapture> capture_;
    std::string path_;
    int next_ = 0;
};

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_PAGE_PICTURES_HPP
