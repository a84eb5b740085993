// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "pictures.hpp"
#include "files.hpp"
#include "inputs.hpp"
#include "picture.hpp"
#ifdef RSACKERMANN_WITH_VIDEOIO
#include "video_timing.hpp"
#endif

#include "opencv2/imgcodecs.hpp"
#include "opencv2/imgproc.hpp"

namespace rsackermann_samples {

std::vector<uchar> PictureMaker::make(const std::string& path, int frame, int width)
{
    cv::Mat image;
    if (frame < 0 && !isVideo(path))
        image = readImage(path);
#ifdef RSACKERMANN_WITH_VIDEOIO
    else if (path != path_ || frame < next_)
    {
        capture_ = std::make_shared<cv::VideoCapture>(openVideo(path));
        path_ = path;
        next_ = 0;
    }
    while (next_ < frame && capture_->grab())
        next_++;
    if (next_ == frame && capture_->read(image))
        next_++;
#endif
    if (image.empty())
        throw InputError(cv::format("frame %d of the video can't be read", frame));
    image = pictureOf(image);
    const double scale = std::min(1., double(width) / image.cols);
    cv::resize(image, image, cv::Size(), scale, scale, cv::INTER_AREA);
    std::vector<uchar> bytes;
    cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, 80});
    return bytes;
}

} // namespace rsackermann_samples
