// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "caption.hpp"

#include "opencv2/imgproc.hpp"

namespace rsackermann_samples {

using namespace cv::rsackermann;

std::string captionOf(const AckermannMotion& motion)
{
    switch (motion.status)
    {
    case MOTION_OK:
        return cv::format("corrected: %.1f px expected, %.1f px left, %.0f %% risk of harm", motion.expectedRaw,
                          motion.expectedResidual, 100 * motion.probabilityWorse);
    case MOTION_NOT_SIGNIFICANT:
        return cv::format("unchanged: %d of %d segments agree, %.1f px expected, no correction would help",
                          motion.inliers, motion.candidates, motion.expectedRaw);
    case MOTION_TOO_FEW_SEGMENTS:
        return cv::format("unchanged: only %d vertical segments", motion.candidates);
    case MOTION_NO_CONSENSUS:
        return cv::format("unchanged: no motion within the limits agrees with %d segments", motion.candidates);
    default:
        return "unchanged: the sensor reads columns";
    }
}

void drawCaption(cv::Mat& image, const std::string& caption)
{
    const int font = cv::FONT_HERSHEY_SIMPLEX, pixelsOfUnit = 22; // height of the font with a scale of 1
    const cv::Size unit = cv::getTextSize(caption, font, 1, 1, 0);
    const double scale = std::min(image.rows / 30. / pixelsOfUnit, 0.96 * image.cols / unit.width);
    const int thickness = std::max(1, cvRound(1.5 * scale));
    const cv::Point corner(image.cols / 50, image.rows - 1 - image.rows / 50);
    cv::putText(image, caption, corner, font, scale, cv::Scalar(), 3 * thickness, cv::LINE_AA);
    cv::putText(image, caption, corner, font, scale, cv::Scalar::all(255), thickness, cv::LINE_AA);
}

} // namespace rsackermann_samples
