// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "drive.hpp"
#include "options.hpp"
#include "table.hpp"

#include "opencv2/imgproc.hpp"
#include "opencv2/video/tracking.hpp"

namespace experiments {

using namespace cv::rsackermann;
using rsackermann_samples::InputError;
using rsackermann_samples::parseNumber;

namespace {

const int STEP = 8;         // pixels between those that are measured
const double BONNET = 0.85; // of the height: where the car itself begins

cv::Mat halved(const cv::Mat& image)
{
    cv::Mat grey, small;
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    cv::resize(grey, small, cv::Size(), 0.5, 0.5, cv::INTER_AREA);
    return small;
}

cv::Mat flowBetween(const cv::Mat& a, const cv::Mat& b)
{
    cv::Mat flow;
    cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM)->calc(a, b, flow);
    return flow;
}

// Where the flow back leads to where the flow came from, and there is texture.
cv::Mat reliable(const cv::Mat& image, const cv::Mat& forward, const cv::Mat& backward)
{
    const double agreement = 0.4, texture = 60, sigma = 4;
    cv::Mat target(forward.size(), CV_32FC2), back, dx, dy, gradient;
    for (int y = 0; y < target.rows; y++)
        for (int x = 0; x < target.cols; x++)
            target.at<cv::Vec2f>(y, x) = cv::Vec2f(float(x), float(y)) + forward.at<cv::Vec2f>(y, x);
    cv::remap(backward, back, target, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar::all(1e3));
    cv::Sobel(image, dx, CV_32F, 1, 0);
    cv::Sobel(image, dy, CV_32F, 0, 1);
    cv::GaussianBlur(dx.mul(dx) + dy.mul(dy), gradient, cv::Size(), sigma);
    cv::Mat result(forward.size(), CV_8U);
    for (int y = 0; y < result.rows; y++)
        for (int x = 0; x < result.cols; x++)
            result.at<uchar>(y, x) = cv::norm(forward.at<cv::Vec2f>(y, x) + back.at<cv::Vec2f>(y, x)) < agreement &&
                                     gradient.at<float>(y, x) > texture;
    return result;
}

} // namespace

std::vector<DriveFrame> readDrive(const std::string& folder)
{
    const double degree = CV_PI / 180, unitsPerSecond = 17;
    std::vector<DriveFrame> frames;
    for (const std::vector<std::string>& row :
         readTable(folder + "/frames.csv",
                   {"file", "width", "height", "fx", "fy", "cx", "cy", "pitch_deg", "roll_deg", "heading_deg",
                    "height_m", "line_delay_s", "units_to_next", "speed_kmh", "yaw_rate_deg_s"}))
    {
        std::vector<double> v(row.size(), 0.);
        for (size_t i = 1; i < row.size(); i++)
            v[i] = row[i].empty() ? 0 : parseNumber(row[i], "frames.csv");
        DriveFrame frame;
        frame.file = folder + "/" + row[0];
        frame.camera =
            RollingShutterCamera(cv::Size(int(v[1]), int(v[2])), cv::Matx33d(v[3], 0, v[5], 0, v[4], v[6], 0, 0, 1));
        frame.camera.setRollPitch(v[8] * degree, v[7] * degree);
        frame.camera.heading = v[9] * degree;
        frame.camera.height = v[10];
        frame.camera.lineDelay = v[11];
        frame.secondsToNext = v[12] / unitsPerSecond;
        frame.speed = v[13] / 3.6;
        frame.yawRate = v[14] * degree;
        frames.push_back(frame);
    }
    return frames;
}

MotionPrior priorOf(const DriveFrame& frame, int given)
{
    MotionPrior prior;
    if (given & 1)
    {
        prior.yawRate = frame.yawRate;
        prior.yawRateSigma = CV_PI / 180;
    }
    if (given & 2)
    {
        prior.speed = frame.speed;
        prior.speedSigma = 2 / 3.6;
    }
    return prior;
}

FlowTruth::FlowTruth(const DriveFrame& frame, const cv::Mat& image, const cv::Mat& next)
    : size(image.size()), lineDelay(frame.camera.lineDelay), reference(frame.camera.referenceRow)
{
    const cv::Mat a = halved(image), b = halved(next), forward = flowBetween(a, b);
    const cv::Mat agrees = reliable(a, forward, flowBetween(b, a));
    const int half = STEP / 2; // in the halved image
    velocity.create((a.rows + half - 1) / half, (a.cols + half - 1) / half, CV_32FC2);
    known.create(velocity.size(), CV_8U);
    for (int i = 0; i < velocity.rows; i++)
        for (int j = 0; j < velocity.cols; j++)
        {
            // A point that has moved down is read later in the next frame.
            const cv::Vec2f flow = 2 * forward.at<cv::Vec2f>(i * half, j * half);
            velocity.at<cv::Vec2f>(i, j) = flow * float(1 / (frame.secondsToNext + flow[1] * lineDelay));
            known.at<uchar>(i, j) = agrees.at<uchar>(i * half, j * half);
        }
}

bool FlowTruth::displacement(const cv::Point2f& raw, const cv::Point2f& corrected, double& distance) const
{
    const int i = cvRound(raw.y / STEP), j = cvRound(raw.x / STEP);
    if (i < 0 || j < 0 || i >= known.rows || j >= known.cols || !known.at<uchar>(i, j))
        return false;
    const cv::Vec2f moved = velocity.at<cv::Vec2f>(i, j) * float((raw.y - reference) * lineDelay);
    distance = cv::norm(raw - cv::Point2f(moved) - corrected);
    return true;
}

void FlowTruth::measure(const cv::Mat& columns, const cv::Mat& rows, double& raw, double& left) const
{
    double sums[2] = {0, 0};
    int count = 0;
    for (int y = STEP; y < int(BONNET * size.height); y += STEP)
        for (int x = STEP; x < size.width - STEP; x += STEP)
        {
            const cv::Point2f p = cv::Point(x, y), q(columns.at<float>(y, x), rows.at<float>(y, x));
            double before, after;
            if (!displacement(p, p, before) || !displacement(q, p, after))
                continue;
            sums[0] += before;
            sums[1] += after;
            count++;
        }
    raw = count ? sums[0] / count : 0;
    left = count ? sums[1] / count : 0;
}

} // namespace experiments
