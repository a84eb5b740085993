// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "opencv2/imgproc.hpp"
#include "opencv2/video/tracking.hpp"
#include "point_tracker.hpp"

namespace cv { namespace rsackermann {

static const int WINDOW = 11;       // pixels, of the tracker
static const int CELL = 8;          // pixels of the halved image; each cell has one point at most
static const double TEXTURE = 4e-4; // least of cornerMinEigenVal for grey values from 0 to 1
static const int REACH = 3;         // halvings: a point may be 40 pixels off its expected place
static const double RETURN = 0.3;   // pixels by which a point that is followed back may miss its origin

double PointTracker::reach(const Size& imageSize, size_t maxPixels)
{
    const double gradient = 1; // pixels to each side
    Size size = imageSize;
    int scale = 1;
    for (; size_t(size.width) * size_t(size.height) > maxPixels; scale *= 2)
        size = Size(size.width / 2, size.height / 2);
    return (0.5 * WINDOW + gradient) * scale;
}

// The point with the most texture of each cell.
void PointTracker::findPoints(const Mat& gray)
{
    points.clear();
    if (gray.cols < 2 || gray.rows < 2)
        return;
    resize(gray, half, Size(gray.cols / 2, gray.rows / 2), 0, 0, INTER_AREA);
    cornerMinEigenVal(half, response, 3);
    for (int y = 0; y < half.rows; y += CELL)
        for (int x = 0; x < half.cols; x += CELL)
        {
            const Rect cell = Rect(x, y, CELL, CELL) & Rect(1, 1, half.cols - 2, half.rows - 2);
            if (cell.empty())
                continue;
            double most;
            Point place;
            minMaxLoc(response(cell), 0, &most, 0, &place);
            if (most > TEXTURE)
                points.push_back(2 * Point2f(place + cell.tl()) + Point2f(0.5f, 0.5f));
        }
}

// Down to the smallest image that the window fits in: that one is the last.
static int buildPyramid(const Mat& image, std::vector<Mat>& pyramid)
{
    const int allLevels = 31;
    return buildOpticalFlowPyramid(image, pyramid, Size(WINDOW, WINDOW), allLevels, true, BORDER_REFLECT_101,
                                   BORDER_CONSTANT, false);
}

int PointTracker::makePyramid(const Mat& gray, std::vector<Mat>& pyramid, Mat& image)
{
    int halvings = 0;
    image = gray;
    for (; image.total() > maxPixels; halvings++)
    {
        // An odd last row or column is left out, so that no place moves.
        const Size size(std::max(image.cols / 2, 1), std::max(image.rows / 2, 1));
        Mat& target = smaller[halvings % 2];
        resize(image(Rect(Point(), size * 2) & Rect(Point(), image.size())), target, size, 0, 0, INTER_AREA);
        image = target;
    }
    levels = buildPyramid(image, pyramid);
    return halvings;
}

/* PointPair::weak of a window with the sum H = sum g g^T of its gradients g. The tracker solves H d = b, and what isn't
noise, as the stairs of an edge, is as large in b along an edge as across it: the covariance is that of H^-2. */
static Point2d weakDirection(const Matx22d& sum)
{
    const double mean = (sum(0, 0) + sum(1, 1)) / 2, half = (sum(0, 0) - sum(1, 1)) / 2,
                 difference = std::hypot(half, sum(0, 1)), angle = std::atan2(sum(0, 1), half) / 2,
                 ratio = (mean + difference) / std::max(mean - difference, FLT_EPSILON * mean); // of the eigenvalues
    return std::sqrt(ratio * ratio - 1) * Point2d(-std::sin(angle), std::cos(angle));
}

/* Where the displacement is that of the point's window. The tracker minimizes the squares of differences of intensity,
so that the displacements of its pixels, d + a (x - centre) in what comes nearer, count with the matrix g g^T of the
gradient g: it finds d for centre = (sum g g^T)^-1 sum g g^T x. */
Point2f PointTracker::centreOf(const Point2f& point, Point2d& weak) const
{
    const Mat& gradients = now[1];
    const Rect window = Rect(cvFloor(point.x) - WINDOW / 2, cvFloor(point.y) - WINDOW / 2, WINDOW + 1, WINDOW + 1) &
                        Rect(Point(), gradients.size());
    Matx22d sum = Matx22d::eye() * 1e-9; // there may be no texture
    Vec2d moment;
    for (int y = window.y; y < window.br().y; y++)
        for (int x = window.x; x < window.br().x; x++)
        {
            const Vec2d gradient = gradients.at<Vec2s>(y, x);
            const Matx22d weight = gradient * gradient.t();
            sum += weight;
            moment += weight * Vec2d(x - point.x, y - point.y);
        }
    weak = weakDirection(sum);
    const Vec2d offset = sum.inv() * moment;
    return point + Point2f(float(offset[0]), float(offset[1]));
}

// The points that are found in another image, from where they are followed back as far as the prediction was.
void PointTracker::follow(const std::vector<Mat>& to, const PointPrediction& predict, Found& result)
{
    result.pairs.clear();
    result.points.clear();
    if (points.empty() || to.empty() || now[0].size() != to[0].size())
        return;
    const double shift = (scale - 1) / 2.; // centre of the first pixel of the small image
    const Point2d origin(shift, shift);
    predicted.clear();
    for (const Point2f& point : points)
    {
        const Point2d raw = Point2d(point) * scale + origin;
        predicted.push_back(point + Point2f(((predict ? predict(raw) : raw) - raw) * (1. / scale)));
    }
    const Size window(WINDOW, WINDOW);
    const TermCriteria criteria(TermCriteria::COUNT + TermCriteria::EPS, 10, 0.03);
    there = predicted;
    calcOpticalFlowPyrLK(now, to, points, there, found, error, window, predict ? std::min(levels, REACH) : levels,
                         criteria, OPTFLOW_USE_INITIAL_FLOW);
    // From a prediction's neighbour many a place would lead back to the point itself: as good a start is as far away.
    returned = points;
    for (size_t i = 0; predict && i < points.size(); i++)
        returned[i] += there[i] - predicted[i];
    calcOpticalFlowPyrLK(to, now, there, returned, foundAgain, error, window, 1, criteria, OPTFLOW_USE_INITIAL_FLOW);
    const Rect2d inside(0, 0, now[0].cols - 1, now[0].rows - 1);
    for (size_t i = 0; i < points.size(); i++)
    {
        if (!found[i] || !foundAgain[i] || norm(returned[i] - points[i]) >= RETURN)
            continue;
        Point2d weak;
        const Point2d centre = centreOf(points[i], weak), other = centre + Point2d(there[i] - points[i]);
        // Texture in nearly one direction alone doesn't determine it.
        if (2 * norm(centre - Point2d(points[i])) > WINDOW || !inside.contains(centre))
            continue;
        result.pairs.push_back({other * scale + origin, centre * scale + origin, weak});
        result.points.push_back(i);
    }
}

void PointTracker::follow(const std::vector<Mat>& to, const PointPredictions& predictions,
                          std::vector<PointPair>& pairs)
{
    followAll(to, predictions, pairs);
    if (points.empty() || to.empty() || pairs.size() >= SAME_SCENE * points.size())
        return;
    // Another exposure loses what is the same.
    Scalar mean, otherMean, deviation, otherDeviation;
    meanStdDev(now[0], mean, deviation);
    meanStdDev(to[0], otherMean, otherDeviation);
    const double gain = deviation[0] / std::max(otherDeviation[0], 1.);
    to[0].convertTo(exposed, -1, gain, mean[0] - gain * otherMean[0]);
    buildPyramid(exposed, exposedPyramid);
    followAll(exposedPyramid, predictions, pairsExposed);
    if (pairsExposed.size() > pairs.size())
        pairs.swap(pairsExposed);
}

void PointTracker::followAll(const std::vector<Mat>& to, const PointPredictions& predictions,
                             std::vector<PointPair>& pairs)
{
    tried.resize(predictions.all.size());
    for (size_t i = 0; i < tried.size(); i++)
    {
        follow(to, predictions.all[i], tried[i]);
        if (tried[i].pairs.size() >= predictions.enough * points.size())
            tried.resize(i + 1);
    }
    std::stable_sort(tried.begin(), tried.end(),
                     [](const Found& a, const Found& b) { return a.pairs.size() > b.pairs.size(); });
    if (!tried.empty() && tried[0].pairs.size() >= predictions.enough * points.size())
        tried.resize(1);
    pairs.clear();
    isTaken.assign(points.size(), 0);
    for (const Found& some : tried)
        for (size_t i = 0; i < some.pairs.size(); i++)
            if (!isTaken[some.points[i]])
            {
                isTaken[some.points[i]] = 1;
                pairs.push_back(some.pairs[i]);
            }
}

void PointTracker::set(const Mat& gray, int scale_)
{
    std::swap(before, now);
    pointsBefore = before.empty() ? 0 : points.size();
    Mat image;
    scale = scale_ << makePyramid(gray, now, image);
    findPoints(image);
}

void PointTracker::setNext(const Mat& gray)
{
    Mat image;
    makePyramid(gray, before, image); // whose image has been used
}

void PointTracker::track(Other other, std::vector<PointPair>& pairs, const PointPredictions& predictions)
{
    follow(other == KEPT ? kept : before, predictions, pairs);
}

bool PointTracker::keepBefore()
{
    if (pointsBefore == 0)
        return false;
    kept.swap(before);
    return true;
}

}} // namespace cv::rsackermann
