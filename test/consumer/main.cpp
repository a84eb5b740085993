// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Corrects a grey image with the installed library: there is nothing to see, so it must come back as it is.

#include "opencv2/rsackermann.hpp"
#include "opencv2/imgproc.hpp"
#include <iostream>

namespace {

cv::rsackermann::AckermannMotion correct(const cv::Mat& image, cv::Mat& corrected)
{
    const auto camera = cv::rsackermann::RollingShutterCamera::fromFocal(image.size());
#ifdef RSACKERMANN_CORE_ONLY
    const auto motion = cv::rsackermann::AckermannEstimator::create(camera)->estimateFromImage(image);
    cv::Mat map1, map2;
    cv::rsackermann::WarpMapGenerator::create(camera)->initRectifyMap(motion, map1, map2);
    cv::remap(image, corrected, map1, map2, cv::INTER_LINEAR);
    return motion;
#else
    return cv::rsackermann::RollingShutterCorrector::create(camera)->correct(image, corrected);
#endif
}

} // namespace

int main()
{
    const cv::Mat image(120, 160, CV_8UC1, cv::Scalar(90));
    cv::Mat corrected;
    const cv::rsackermann::AckermannMotion motion = correct(image, corrected);

    if (motion.status != cv::rsackermann::MOTION_TOO_FEW_SEGMENTS)
    {
        std::cerr << "status " << motion.status << " without any segment" << std::endl;
        return 1;
    }
    if (corrected.size() != image.size() || cv::norm(image, corrected, cv::NORM_INF) != 0)
    {
        std::cerr << "an image without motion was changed" << std::endl;
        return 1;
    }
    return 0;
}
