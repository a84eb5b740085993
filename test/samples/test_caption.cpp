// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// What the overlay says of a correction.

#include "caption.hpp"

#include "opencv2/ts.hpp"

namespace opencv_test { namespace {

using namespace cv::rsackermann;

TEST(Caption, tells_what_is_expected_or_why_not)
{
    AckermannMotion motion;
    motion.candidates = 43;
    motion.inliers = 12;
    motion.expectedRaw = 4.52;
    motion.expectedResidual = 0.71;
    motion.probabilityWorse = 0.031;
    const std::pair<int, const char*> captions[] = {
        {MOTION_OK, "corrected: 4.5 px expected, 0.7 px left, 3 % risk of harm"},
        {MOTION_NOT_SIGNIFICANT, "unchanged: 12 of 43 segments agree, 4.5 px expected, no correction would help"},
        {MOTION_TOO_FEW_SEGMENTS, "unchanged: only 43 vertical segments"},
        {MOTION_NO_CONSENSUS, "unchanged: no motion within the limits agrees with 43 segments"},
        {MOTION_NOT_OBSERVABLE, "unchanged: the sensor reads columns"}};
    for (const auto& expected : captions)
    {
        motion.status = expected.first;
        EXPECT_EQ(expected.second, rsackermann_samples::captionOf(motion));
    }
}

// White on black at the bottom, whatever the size and whatever is below.
TEST(Caption, is_within_the_image)
{
    for (const cv::Size& size : {cv::Size(200, 150), cv::Size(640, 380), cv::Size(3000, 200), cv::Size(300, 2000)})
    {
        cv::Mat image(size, CV_8UC3, cv::Scalar::all(128)), white, black;
        rsackermann_samples::drawCaption(image, "unchanged: no motion within the limits agrees with 43 segments");
        cv::inRange(image, cv::Scalar::all(200), cv::Scalar::all(255), white);
        cv::inRange(image, cv::Scalar::all(0), cv::Scalar::all(60), black);
        std::vector<cv::Point> places;
        cv::findNonZero(black, places);
        const cv::Rect box = cv::boundingRect(places);
        EXPECT_GT(cv::countNonZero(white), 100) << size;
        EXPECT_GT(box.y, size.height * 9 / 10 - 6) << size;
        EXPECT_LT(box.br().x, size.width) << size;
        EXPECT_GT(box.width, std::min(size.width / 4, 300)) << size;
    }
}

}} // namespace opencv_test
