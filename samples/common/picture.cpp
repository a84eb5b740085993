// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "picture.hpp"

#include "opencv2/imgproc.hpp"

namespace rsackermann_samples {

cv::Mat pictureOf(const cv::Mat& image)
{
    cv::Mat picture;
    if (image.depth() == CV_16U)
        image.convertTo(picture, CV_8U, 1 / 257.);
    else
        picture = image.clone();
    if (picture.channels() == 1)
        cv::cvtColor(picture, picture, cv::COLOR_GRAY2BGR);
    else if (picture.channels() == 4)
        cv::cvtColor(picture, picture, cv::COLOR_BGRA2BGR);
    return picture;
}

} // namespace rsackermann_samples
