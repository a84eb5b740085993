// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_REPEATED_IMAGES_HPP
#define RSACKERMANN_SAMPLES_REPEATED_IMAGES_HPP

#include "opencv2/core.hpp"
#include <string>
#include <vector>

namespace rsackermann_samples {

//! By how much the images of a sequence differ.
class ImageChange
{
public:
    //! @return mean absolute difference to the image before, over some of the pixels; NaN: there is none of this kind.
    double to(const cv::Mat& image);

private:
    cv::Mat before_;
};

//! What to say of a sequence of which a tenth of the images or more repeat the one before, as converters of frame rates
//! let them, but for what an encoder changes: a few at a time, between others that move; else nothing.
//! @param changes of ImageChange.
std::string repeatedImages(const std::vector<double>& changes);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_REPEATED_IMAGES_HPP
