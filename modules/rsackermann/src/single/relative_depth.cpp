// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../camera/lens.hpp"
#include "../motion/contradiction.hpp"
#include "../optim/median.hpp"
#include "relative_depth.hpp"

namespace cv { namespace rsackermann {

// doc/theory.md, "Relative depth".
static const double NOISE = 0.15;     // relative, of a pixel: what exceeds it is an edge, or no road
static const double LEAST_ROAD = 0.2; // share of what is below the horizon
static const double SIDE = 0.003;     // beside a segment, of the longer side

// Of other lines beside a segment, parts of the longer side.
static const double BESIDE[] = {0.025, 0.0375, 0.05, 0.0625, 0.075};

RelativeDepth::RelativeDepth(const DepthMap& depth_, const RollingShutterCamera& camera, const Matx33d& up)
    : depth(depth_), longerSide(std::max(camera.imageSize.width, camera.imageSize.height)), zero(0), slope_(1), share(0)
{
    fitRoad(camera, up);
}

bool RelativeDepth::hasRoad() const
{
    return share >= LEAST_ROAD;
}

double RelativeDepth::valueAt(const DepthMap& depth, const Point2d& pixel)
{
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    const Mat& values = depth.values;
    const Point p(cvRound(pixel.x), cvRound(pixel.y));
    if (!Rect(Point(), values.size()).contains(p))
        return unknown;
    const double value = values.depth() == CV_16U ? values.at<ushort>(p) : values.at<float>(p);
    if (depth.kind == DEPTH_RELATIVE)
        return value;
    return value > 0 && std::isfinite(value) ? 1 / (depth.scale * value) : unknown;
}

double RelativeDepth::medianAround(const DepthMap& depth, const Point2d& pixel, double reach)
{
    enum { STEPS = 5, ALONG = 2 * STEPS + 1 }; // to each side: enough for a median
    double found[ALONG * ALONG];
    int count = 0;
    for (int i = 0; i < ALONG * ALONG; i++)
    {
        const Point way(i % ALONG - STEPS, i / ALONG - STEPS);
        const double value = valueAt(depth, pixel + reach / STEPS * Point2d(way));
        if (std::isfinite(value))
            found[count++] = value;
    }
    if (count == 0)
        return std::numeric_limits<double>::quiet_NaN();
    return medianOf(found, found + count);
}

double RelativeDepth::at(const Point2d& pixel) const
{
    const double value = valueAt(depth, pixel);
    return std::isfinite(value) ? (value - zero) / slope_ : std::numeric_limits<double>::quiet_NaN();
}

void RelativeDepth::fitRoad(const RollingShutterCamera& camera, const Matx33d& up)
{
    const double step = std::max(longerSide / 40, 1.), leastDown = 0.03;
    std::vector<Point2d> pixels, below; // y component of a ray, value
    for (double y = step / 2; y < camera.imageSize.height - 1; y += step)
        for (double x = step / 2; x < camera.imageSize.width - 1; x += step)
            pixels.push_back(Point2d(x, y));
    const std::vector<Vec3d> rays = bearingsOf(camera, up, pixels);
    for (size_t i = 0; i < rays.size(); i++)
    {
        const double down = rays[i][1], value = at(pixels[i]);
        if (down > leastDown && std::isfinite(value))
            below.push_back(Point2d(down, value));
    }
    if (below.size() < size_t(LEAST_PIXELS))
        return;
    sampleRoad(below);
    refineRoad(below);
}

// Deviation from a road as a part of the largest one.
static double deviation(const Point2d& p, double zero, double slope)
{
    return ((p.y - zero) / (slope * p.x) - 1) / NOISE;
}

// The line with the most support among those through two pixels, or through one of a depth in metres, whose inverse is
// 0 at infinity.
void RelativeDepth::sampleRoad(const std::vector<Point2d>& below)
{
    const int samples = 300;
    RNG rng(1);
    double best = 0;
    for (int i = 0; i < samples; i++)
    {
        const Point2d a = below[rng.uniform(0, int(below.size()))];
        const Point2d b = depth.kind == DEPTH_METRIC ? Point2d() : below[rng.uniform(0, int(below.size()))];
        const double m = (b.y - a.y) / (b.x - a.x), infinity = a.y - m * a.x;
        if (!(m > 0) || !std::isfinite(m))
            continue;
        double score = 0;
        for (const Point2d& p : below)
        {
            const double r = deviation(p, infinity, m);
            score += std::max(1 - r * r, 0.);
        }
        if (score > best)
        {
            best = score;
            slope_ = m;
            zero = infinity;
        }
    }
}

// Errors of a depth are relative ones.
void RelativeDepth::refineRoad(const std::vector<Point2d>& below)
{
    const int rounds = 5;
    for (int round = 0; round < rounds; round++)
    {
        double w = depth.kind == DEPTH_METRIC ? 1 / DBL_EPSILON : 0, x = 0, y = 0, xx = 0, xy = 0; // at infinity
        int count = 0;
        for (const Point2d& p : below)
        {
            if (!(std::abs(deviation(p, zero, slope_)) <= 1))
                continue;
            const double weight = 1 / (p.x * p.x);
            w += weight;
            x += weight * p.x;
            y += weight * p.y;
            xx += weight * p.x * p.x;
            xy += weight * p.x * p.y;
            count++;
        }
        const double m = (w * xy - x * y) / (w * xx - x * x);
        if (count < LEAST_PIXELS || !(m > 0) || !std::isfinite(m))
        {
            share = 0;
            return;
        }
        slope_ = m;
        zero = (y - m * x) / w;
        share = count / double(below.size());
    }
}

bool RelativeDepth::median(const Vec4d& s, double shift, double& height) const
{
    const Point2d first(s[0], s[1]), way(s[2] - s[0], s[3] - s[1]);
    const double length = norm(way);
    const Point2d across(shift * way.y / length, -shift * way.x / length);
    const int steps = std::max(cvRound(length), 1);
    std::vector<double> heights;
    for (int i = 0; i <= steps; i++)
    {
        const double h = at(first + across + i / double(steps) * way);
        if (std::isfinite(h))
            heights.push_back(std::max(h, 0.));
    }
    if (2 * heights.size() < size_t(steps))
        return false;
    height = medianOf(heights.begin(), heights.end());
    return true;
}

bool RelativeDepth::findSides(const Vec4d& segment, double shift, double& nearer, double& farther) const
{
    const double side = std::max(SIDE * longerSide, 2.);
    if (!median(segment, shift - side, farther) || !median(segment, shift + side, nearer))
        return false;
    if (nearer < farther)
        std::swap(nearer, farther);
    return true;
}

bool RelativeDepth::besideSegment(const Vec4d& segment, double& height) const
{
    double farther;
    return findSides(segment, 0, height, farther);
}

bool RelativeDepth::isEdge(const Vec4d& segment, double shift, bool& edge) const
{
    double nearer, farther;
    if (!findSides(segment, shift, nearer, farther))
        return false;
    edge = nearer - farther > NOISE * nearer;
    return true;
}

double RelativeDepth::edgesInCommon(const Mat& segments, double minLength) const
{
    double sum = 0, squares = 0;
    int count = 0;
    for (int i = 0; i < segments.rows; i++)
    {
        const Vec4d segment(segments.ptr<double>(i));
        bool edge, other;
        if (!(std::hypot(segment[0] - segment[2], segment[1] - segment[3]) >= std::max(minLength, 1.)) ||
            !isEdge(segment, 0, edge))
            continue;
        double edges = 0;
        int lines = 0;
        for (double beside : BESIDE)
            for (int sign = -1; sign <= 1; sign += 2)
                if (isEdge(segment, sign * beside * longerSide, other))
                {
                    edges += other;
                    lines++;
                }
        if (lines == 0)
            continue;
        const double more = edge - edges / lines;
        sum += more;
        squares += more * more;
        count++;
    }
    if (count < 2)
        return 0;
    // If all agree, as if one of them didn't
    const double n = count;
    return sum / std::sqrt(std::max(squares - sum * sum / n, 1 - 1 / n));
}

bool RelativeDepth::isInAnotherUnit(double cameraHeight, const AckermannEstimator::Params& params) const
{
    const double expected = cameraHeight > 0 ? cameraHeight : params.priorHeight;
    return hasRoad() && std::abs(std::log(slope_ * expected)) > CONTRADICTION * params.priorHeightLogSigma;
}

}} // namespace cv::rsackermann
