// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "forward_splat.hpp"

#include "opencv2/imgproc.hpp"
#include <cmath>

namespace paper {

using namespace cv::rsackermann;

namespace {

// Places of all pixels, row by row.
cv::Mat placesOf(const RollingShutterCamera& camera, const AckermannMotion& motion, cv::Mat& known)
{
    cv::Mat pixels(camera.imageSize.area(), 1, CV_32FC2), places;
    for (int i = 0; i < pixels.rows; i++)
        pixels.at<cv::Point2f>(i) = cv::Point2f(float(i % camera.imageSize.width), float(i / camera.imageSize.width));
    WarpMapGenerator::create(camera)->correctPoints(motion, pixels, places, cv::noArray(), known);
    return places;
}

// Means of what is known in windows of 3 and then of 7 pixels.
void fillHoles(const cv::Mat& sum, const cv::Mat& weight, cv::Mat& colour, cv::Mat& filled)
{
    for (int window : {3, 7})
    {
        cv::Mat sums, weights;
        cv::boxFilter(sum, sums, -1, cv::Size(window, window), cv::Point(-1, -1), false, cv::BORDER_CONSTANT);
        cv::boxFilter(weight, weights, -1, cv::Size(window, window), cv::Point(-1, -1), false, cv::BORDER_CONSTANT);
        for (int y = 0; y < sum.rows; y++)
            for (int x = 0; x < sum.cols; x++)
                if (!filled.at<uchar>(y, x) && weights.at<float>(y, x) > 0.5f)
                {
                    colour.at<cv::Vec3f>(y, x) = sums.at<cv::Vec3f>(y, x) * (1 / weights.at<float>(y, x));
                    filled.at<uchar>(y, x) = 255;
                }
    }
}

} // namespace

cv::Mat correctBySplatting(const RollingShutterCamera& camera, const AckermannMotion& motion, const cv::Mat& image,
                           cv::Mat& mask)
{
    CV_Assert(image.type() == CV_8UC3 && image.size() == camera.imageSize);
    cv::Mat known;
    const cv::Mat places = placesOf(camera, motion, known);
    cv::Mat sum(image.size(), CV_32FC3, cv::Scalar::all(0)), weight(image.size(), CV_32FC1, cv::Scalar(0));
    for (int i = 0; i < places.rows; i++)
    {
        if (!known.at<uchar>(i))
            continue;
        const cv::Point2f p = places.at<cv::Point2f>(i);
        const cv::Vec3f colour(image.at<cv::Vec3b>(i / image.cols, i % image.cols));
        const int x0 = cvFloor(p.x), y0 = cvFloor(p.y);
        for (int y = y0; y <= y0 + 1; y++)
            for (int x = x0; x <= x0 + 1; x++)
            {
                const float share = (1 - std::abs(p.x - float(x))) * (1 - std::abs(p.y - float(y)));
                if (x < 0 || y < 0 || x >= image.cols || y >= image.rows || share <= 0)
                    continue;
                sum.at<cv::Vec3f>(y, x) += colour * share;
                weight.at<float>(y, x) += share;
            }
    }
    cv::Mat colour(image.size(), CV_32FC3, cv::Scalar::all(0));
    mask = cv::Mat(image.size(), CV_8UC1, cv::Scalar(0));
    for (int y = 0; y < image.rows; y++)
        for (int x = 0; x < image.cols; x++)
            if (weight.at<float>(y, x) > 0.25f)
            {
                colour.at<cv::Vec3f>(y, x) = sum.at<cv::Vec3f>(y, x) * (1 / weight.at<float>(y, x));
                mask.at<uchar>(y, x) = 255;
            }
    fillHoles(sum, weight, colour, mask);
    cv::Mat result;
    colour.convertTo(result, CV_8U);
    return result;
}

} // namespace paper
