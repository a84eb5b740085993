// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../camera/lens.hpp"
#include "upright_segment.hpp"

namespace cv { namespace rsackermann {

// Whether both ends are in the image or, by the inaccuracy of a detector, just outside; never for NaN.
static bool isInImage(const double* segment, const Size& size)
{
    for (int i = 0; i < 4; i += 2)
        if (!(segment[i] >= -END_SIGMA && segment[i] <= size.width - 1 + END_SIGMA && segment[i + 1] >= -END_SIGMA &&
              segment[i + 1] <= size.height - 1 + END_SIGMA))
            return false;
    return true;
}

// A ray in the upright frame with z = 1. Returns false behind the camera.
static bool uprightBearing(const Matx33d& upright, const Vec3d& ray, Vec3d& bearing)
{
    bearing = upright * ray;
    if (!(bearing[2] > 1e-3))
        return false;
    bearing *= 1 / bearing[2];
    return true;
}

static bool isLeft(const UprightSegment& a, const UprightSegment& b)
{
    const double xa = a.u[0] + a.v[0], xb = b.u[0] + b.v[0];
    return xa != xb ? xa < xb : a.index < b.index;
}

void selectCandidates(const Mat& segments, const RollingShutterCamera& camera, const AckermannEstimator::Params& params,
                      std::vector<UprightSegment>& verticals, std::vector<UprightSegment>& others)
{
    verticals.clear();
    others.clear();
    std::vector<Point2d> ends;
    std::vector<int> indices;
    for (int i = 0; i < segments.rows; i++)
    {
        const double* s = segments.ptr<double>(i);
        if (!isInImage(s, camera.imageSize) || !(std::hypot(s[0] - s[2], s[1] - s[3]) >= params.minLength))
            continue;
        ends.push_back(Point2d(s[0], s[1]));
        ends.push_back(Point2d(s[2], s[3]));
        ends.push_back(0.5 * (Point2d(s[0], s[1]) + Point2d(s[2], s[3])));
        indices.push_back(i);
    }
    const std::vector<Vec3d> rays = bearingsOf(camera, Matx33d::eye(), ends);

    const MotionLimits limits(camera, params);
    for (size_t k = 0; k < indices.size(); k++)
    {
        UprightSegment c;
        if (!uprightBearing(camera.uprightRotation, rays[3 * k], c.u) ||
            !uprightBearing(camera.uprightRotation, rays[3 * k + 1], c.v))
            continue;
        c.timeU = camera.rowTime(ends[3 * k]);
        c.timeV = camera.rowTime(ends[3 * k + 1]);
        c.length = norm(ends[3 * k] - ends[3 * k + 1]);
        c.sagitta = camera.cameraMatrix(0, 0) * norm(rays[3 * k + 2] - 0.5 * (rays[3 * k] + rays[3 * k + 1]));
        c.index = indices[k];
        const double dx = std::abs(c.u[0] - c.v[0]), dt = std::abs(c.timeU - c.timeV);
        const double possible = limits.maxSlant((c.u[0] + c.v[0]) / 2, camera.heading) + params.slantTolerance;
        const double steepest = limits.areMetric ? possible : std::min(possible, params.maxSlant);
        if (dt > 0 && dx <= steepest * dt)
            verticals.push_back(c);
        else if (dx > std::max(steepest, params.maxSlant) * dt) // nearly vertical ones belong to neither
            others.push_back(c);
    }
    std::sort(verticals.begin(), verticals.end(), isLeft);
}

}} // namespace cv::rsackermann
