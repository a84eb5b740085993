// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "opencv2/imgproc.hpp"
#include "opencv2/video/tracking.hpp"
#include "point_tracker.hpp"

namespace cv {
namespace rsackermann {

static const size_t MAX_PIXELS = 300000; // larger images are halved: points can still be told to a tenth of a pixel of the result
static const int WINDOW = 11;            // pixels, of the tracker
static const int LEVELS = 4;             // of the pyramid, besides the image itself
static const int CELL = 8;               // pixels of the halved image; each cell has one point at most
static const double TEXTURE = 4e-4;      // least of cornerMinEigenVal for grey values from 0 to 1
static const double RETURN = 0.3;        // pixels by which a point that is followed back may miss its origin

void PointTracker::reset()
{
    before.clear();
}

// The point with the most texture of each cell.
void PointTracker::findPoints(const Mat& gray)
{
    resize(gray, half, Size(gray.cols / 2, gray.rows / 2), 0, 0, INTER_AREA);
    cornerMinEigenVal(half, response, 3);
    points.clear();
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

// The points that are found again in the image before, from where they are followed back.
void PointTracker::follow(int levels)
{
    const Size window(WINDOW, WINDOW);
    const TermCriteria criteria(TermCriteria::COUNT + TermCriteria::EPS, 10, 0.03);
    calcOpticalFlowPyrLK(now, before, points, past, found, error, window, levels, criteria);
    returned = points;
    calcOpticalFlowPyrLK(before, now, past, returned, foundAgain, error, window, 1, criteria, OPTFLOW_USE_INITIAL_FLOW);
    for (size_t i = 0; i < points.size(); i++)
        found[i] = found[i] && foundAgain[i] && norm(returned[i] - points[i]) < RETURN;
}

void PointTracker::track(const Mat& gray, int scale, std::vector<PointPair>& pairs)
{
    pairs.clear();
    const Mat* image = &gray;
    for (int i = 0; image->total() > MAX_PIXELS; i = 1 - i, scale *= 2)
    {
        resize(*image, smaller[i], Size(image->cols / 2, image->rows / 2), 0, 0, INTER_AREA);
        image = &smaller[i];
    }
    const int levels = buildOpticalFlowPyramid(*image, now, Size(WINDOW, WINDOW), LEVELS, true, BORDER_REFLECT_101, BORDER_CONSTANT, false);
    if (!before.empty() && before[0].size() == now[0].size())
    {
        findPoints(*image);
        if (!points.empty())
            follow(levels);
        const double shift = (scale - 1) / 2.; // centre of the first pixel of the small image
        const Point2d origin(shift, shift);
        for (size_t i = 0; i < points.size(); i++)
            if (found[i])
            {
                const PointPair pair = {Point2d(past[i]) * scale + origin, Point2d(points[i]) * scale + origin};
                pairs.push_back(pair);
            }
    }
    std::swap(before, now);
}

}} // namespace cv::rsackermann
