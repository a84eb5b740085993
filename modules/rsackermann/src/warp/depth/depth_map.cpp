// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "opencv2/rsackermann/depth_map.hpp"
#include "../../checks.hpp"

namespace cv { namespace rsackermann {

DepthMap::DepthMap() : camera(DEPTH_RAW), kind(DEPTH_METRIC), scale(1), shift(0), scaleSigma(0.1) {}

DepthMap::DepthMap(const Mat& values_, int camera_, double scale_, int kind_)
    : values(values_), camera(camera_), kind(kind_), scale(scale_), shift(0), scaleSigma(DepthMap().scaleSigma)
{
}

DepthMap DepthMap::fromPoints(InputArray points_, const RollingShutterCamera& camera)
{
    camera.check();
    const Mat points = matrixOf(points_, "points");
    const int count = points.empty() ? 0 : points.dims > 2 ? -1 : points.checkVector(3, -1, false);
    REJECT_IF(count < 0 || (count > 0 && points.depth() != CV_32F && points.depth() != CV_64F),
              "points is a %d x %d matrix of %d dimensions and type %s; N x 3, or N x 1 with three channels, CV_32F or "
              "CV_64F is expected",
              points.rows, points.cols, points.dims, typeToString(points.type()).c_str());
    const Rect2d image(Point2d(), Size2d(camera.imageSize));
    Mat1f values(camera.imageSize, 0.f);
    Mat places;
    points.convertTo(places, CV_64F);
    places = places.reshape(3, count);
    for (int i = 0; i < count; i++)
    {
        const Vec3d& place = places.at<Vec3d>(i);
        const Vec3d ray = camera.cameraMatrix * (place / place[2]);
        const Point2d pixel(ray[0] + 0.5, ray[1] + 0.5); // from the corner of its first pixel; or not finite
        if (!(place[2] > 0 && place[2] <= FLT_MAX && image.contains(pixel)))
            continue;
        float& value = values(Point(int(pixel.x), int(pixel.y)));
        value = value > 0 ? std::min(value, float(place[2])) : float(place[2]);
    }
    return DepthMap(values, DEPTH_CORRECTED);
}

bool DepthMap::empty() const
{
    return values.empty();
}

void DepthMap::check() const
{
    if (empty())
        return;
    REJECT_IF(values.dims != 2 || (values.type() != CV_32FC1 && values.type() != CV_16UC1),
              "depth.values has %d dimensions and is of type %s; a matrix of type CV_32FC1 or CV_16UC1 is expected",
              values.dims, typeToString(values.type()).c_str());
    REJECT_IF(camera != DEPTH_RAW && camera != DEPTH_CORRECTED,
              "depth.camera is %d; DEPTH_RAW (%d) or DEPTH_CORRECTED (%d) is expected", camera, DEPTH_RAW,
              DEPTH_CORRECTED);
    REJECT_IF(kind != DEPTH_METRIC && kind != DEPTH_RELATIVE,
              "depth.kind is %d; DEPTH_METRIC (%d) or DEPTH_RELATIVE (%d) is expected", kind, DEPTH_METRIC,
              DEPTH_RELATIVE);
    checkPositive(scale, "depth.scale");
    checkFinite(shift, "depth.shift");
    checkRange(scaleSigma, 0, 1, "depth.scaleSigma");
}

}} // namespace cv::rsackermann
