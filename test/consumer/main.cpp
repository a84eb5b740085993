// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Corrects a grey image with the installed library: there is nothing to see, so it must come back as it is.

#include "opencv2/rsackermann.hpp"
#include <iostream>

int main()
{
    const cv::Mat image(120, 160, CV_8UC1, cv::Scalar(90));
    const auto corrector = cv::rsackermann::RollingShutterCorrector::create(
        cv::rsackermann::RollingShutterCamera::fromFocal(image.size()));

    cv::Mat corrected;
    const cv::rsackermann::AckermannMotion motion = corrector->correct(image, corrected);

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
