// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "precomp.hpp"
#include "camera/lens.hpp"
#include "checks.hpp"
#include "motion/compensation.hpp"
#include "opencv2/imgproc.hpp"
#include "scene/planes.hpp"
#include "warp/points.hpp"

namespace cv { namespace rsackermann {

static const int SHIFT = 4; // fractional bits of drawn coordinates

static void drawLine(Mat& image, const Point2d& a, const Point2d& b, const Scalar& colour, int thickness)
{
    // Beyond this cv::line would overflow; what is so far away doesn't reach the image.
    const double limit = 1 << 20;
    if (!(std::abs(a.x) < limit && std::abs(a.y) < limit && std::abs(b.x) < limit && std::abs(b.y) < limit))
        return;
    const double scale = 1 << SHIFT;
    line(image, Point(cvRound(a.x * scale), cvRound(a.y * scale)), Point(cvRound(b.x * scale), cvRound(b.y * scale)),
         colour, thickness, LINE_AA, SHIFT);
}

/** |w| of inlier segments at the compensated columns of their middles (doc/theory.md, "Compensation"); 0 for the
 * others. */
static std::vector<double> inverseDepths(const Mat& segments, const Mat& labels, const RollingShutterCamera& camera,
                                         const AckermannMotion& motion)
{
    std::vector<Point2d> middles;
    for (int i = 0; i < segments.rows; i++)
    {
        const double* s = segments.ptr<double>(i);
        middles.push_back(Point2d((s[0] + s[2]) / 2, (s[1] + s[3]) / 2));
    }
    const std::vector<Vec3d> rays = bearingsOf(camera, motion.uprightRotation(camera), middles);
    std::vector<double> w(middles.size(), 0.);
    for (size_t i = 0; i < w.size(); i++)
    {
        const int label = labels.at<uchar>((int)i);
        if (label != SEGMENT_LEFT_WALL && label != SEGMENT_RIGHT_WALL)
            continue;
        const double side = label == SEGMENT_LEFT_WALL ? 1 : -motion.wallRatio;
        const double B = side * motion.wallSlope, D = side * motion.wallOffset;
        const RowMotion row(motion.alpha, motion.heading(camera), camera.rowTime(middles[i]));
        const double depth =
            std::abs(D - B * RotatedBearing(HorizontalBearing(rays[i][0], rays[i][2]), row).column(B, D));
        w[i] = depth < DBL_MAX ? depth : 0;
    }
    return w;
}

static void drawSegments(Mat& image, const Mat& segments, const Mat& labels, const std::vector<double>& w,
                         int thickness)
{
    const Scalar grey(160, 160, 160), black(0, 0, 0);
    const double nearest = w.empty() ? 0 : *std::max_element(w.begin(), w.end());
    // The most important is drawn last.
    for (int pass = SEGMENT_REJECTED; pass <= SEGMENT_LEFT_WALL; pass++)
        for (int i = 0; i < segments.rows; i++)
        {
            const int label = std::min<int>(labels.at<uchar>(i), SEGMENT_LEFT_WALL);
            if (label != pass)
                continue;
            const double nearness = nearest > 0 ? w[(size_t)i] / nearest : 0;
            const Scalar colour = label == SEGMENT_REJECTED  ? grey
                                  : label == SEGMENT_OUTLIER ? black
                                                             : Scalar(255 * nearness, 0, 255 * (1 - nearness));
            const double* s = segments.ptr<double>(i);
            drawLine(image, Point2d(s[0], s[1]), Point2d(s[2], s[3]), colour,
                     label == SEGMENT_REJECTED ? 1 : thickness);
        }
}

/** Draws the line on which a wall w = D - B x meets the road w = G y, from left to right (doc/theory.md, "Depth"). */
static void drawBorder(Mat& image, double B, double D, const RollingShutterCamera& camera,
                       const AckermannMotion& motion, int thickness)
{
    const int steps = 1000;
    const double maxAzimuth = 1.4;
    const Matx33d down = camera.cameraMatrix * motion.uprightRotation(camera).t();
    std::vector<Point2d> pixels; // of the global-shutter camera
    for (int i = -steps; i <= steps; i++)
    {
        const double x = std::tan(maxAzimuth * i / steps), w = D - B * x;
        const Vec3d p = down * Vec3d(x, w / motion.roadSlope, 1);
        if (w * motion.direction > 0 && p[2] > 0)
            pixels.push_back(Point2d(p[0] / p[2], p[1] / p[2]));
    }
    std::vector<Place> places;
    distortPoints(camera, WarpMapGenerator::Params(), camera.cameraMatrix, motion, pixels, std::vector<double>(),
                  places);
    for (size_t i = 1; i < places.size(); i++)
        if (places[i - 1].exists && places[i].exists)
            drawLine(image, places[i - 1].point, places[i].point, Scalar(0, 255, 255), thickness);
}

void drawMotion(InputOutputArray image_, InputArray segments_, InputArray labels_, const RollingShutterCamera& camera,
                const AckermannMotion& motion, int thickness)
{
    CV_INSTRUMENT_REGION();
    camera.check();
    checkMotion(motion);
    Mat image = matrixOf(image_, "image");
    REJECT_IF(image.type() != CV_8UC3 || image.size() != camera.imageSize,
              "image is a %d x %d matrix of type %s; CV_8UC3 of the camera's size %d x %d is expected", image.cols,
              image.rows, typeToString(image.type()).c_str(), camera.imageSize.width, camera.imageSize.height);
    REJECT_IF(thickness < 1 || thickness > 255, "thickness is %d; 1 to 255 is expected", thickness);
    const Mat segments = segmentRows(segments_), labels = matrixOf(labels_, "labels");
    REJECT_IF((int)labels.total() != segments.rows || (segments.rows > 0 && labels.type() != CV_8U),
              "labels has %d elements of type %s; %d of CV_8U, one for each segment, are expected", (int)labels.total(),
              typeToString(labels.type()).c_str(), segments.rows);

    if (motion.status == MOTION_OK && motion.roadSlope != 0)
        for (const double side : {1., -motion.wallRatio})
            if (side == 1 || side < 0)
                drawBorder(image, side * motion.wallSlope, side * motion.wallOffset, camera, motion, thickness);
    drawSegments(image, segments, labels, inverseDepths(segments, labels, camera, motion), thickness);
}

}} // namespace cv::rsackermann
