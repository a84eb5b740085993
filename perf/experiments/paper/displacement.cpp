// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "displacement.hpp"

#include "opencv2/imgproc.hpp"
#include "opencv2/opencv_modules.hpp"
#ifdef HAVE_OPENCV_FEATURES // where OpenCV 5 has goodFeaturesToTrack
#include "opencv2/features.hpp"
#endif
#include <cmath>
#include <limits>

namespace paper {

using namespace cv::rsackermann;

DenseTruth::DenseTruth(const street::StreetRenderer& renderer, const cv::Size& size) : raw_(0)
{
    const int step = 4;
    for (int y = step / 2; y < size.height; y += step)
        for (int x = step / 2; x < size.width; x += step)
        {
            cv::Point2d place;
            if (!renderer.toGlobal(cv::Point2d(x, y), place))
                continue;
            pixels_.push_back(cv::Point2f(float(x), float(y)));
            places_.push_back(cv::Point2f(place));
            raw_ += cv::norm(place - cv::Point2d(x, y));
        }
    raw_ /= std::max(1, pixels_.rows);
}

double DenseTruth::left(const RollingShutterCamera& camera, const AckermannMotion& motion) const
{
    cv::Mat corrected, known;
    WarpMapGenerator::create(camera)->correctPoints(motion, pixels_, corrected, cv::noArray(), known);
    double sum = 0;
    int count = 0;
    for (int i = 0; i < corrected.rows; i++)
        if (known.at<uchar>(i))
        {
            sum += cv::norm(corrected.at<cv::Point2f>(i) - places_.at<cv::Point2f>(i));
            count++;
        }
    return count ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

namespace {

// The place of an extremum between its neighbours' values, -0.5..0.5, by a parabola.
double peak(double before, double at, double after)
{
    const double bend = before - 2 * at + after;
    return bend < 0 ? 0.5 * (before - after) / bend : 0;
}

} // namespace

double patchDisplacement(const cv::Mat& global, const cv::Mat& image, const cv::Mat& mask)
{
    const int half = 7, reach = 12, border = half + reach + 1;
    const double similar = 0.8;
    cv::Mat grey, other;
    cv::cvtColor(global, grey, cv::COLOR_BGR2GRAY);
    cv::cvtColor(image, other, cv::COLOR_BGR2GRAY);
    std::vector<cv::Point2f> corners;
    cv::goodFeaturesToTrack(grey, corners, 400, 0.01, 8);
    double sum = 0;
    int count = 0;
    for (const cv::Point2f& corner : corners)
    {
        const cv::Point p = corner;
        if (p.x < border || p.y < border || p.x >= grey.cols - border || p.y >= grey.rows - border)
            continue;
        const cv::Rect patch(p.x - half, p.y - half, 2 * half + 1, 2 * half + 1);
        const cv::Rect around(p.x - half - reach, p.y - half - reach, 2 * (half + reach) + 1, 2 * (half + reach) + 1);
        if (!mask.empty() && cv::countNonZero(mask(around)) < around.area())
            continue;
        cv::Mat scores;
        cv::matchTemplate(other(around), grey(patch), scores, cv::TM_CCOEFF_NORMED);
        double best = 0;
        cv::Point at;
        cv::minMaxLoc(scores, nullptr, &best, nullptr, &at);
        if (best < similar || at.x == 0 || at.y == 0 || at.x == 2 * reach || at.y == 2 * reach)
            continue;
        const cv::Mat_<float> s(scores);
        const double dx = at.x - reach + peak(s(at.y, at.x - 1), s(at.y, at.x), s(at.y, at.x + 1));
        const double dy = at.y - reach + peak(s(at.y - 1, at.x), s(at.y, at.x), s(at.y + 1, at.x));
        sum += std::hypot(dx, dy);
        count++;
    }
    return count ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

} // namespace paper
