// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../camera/lens.hpp"
#include "displacement_field.hpp"
#include "opencv2/rsackermann/motion.hpp"

namespace cv { namespace rsackermann {

static const double NEXT_TO_NOTHING = 0.05; // of the displacement

// Derivative of the raw pixel by its ray (u, v, 1): a lens shows what is near the border smaller than a pinhole does.
static Matx22d byRay(const Lens<double>& lens, double u, double v)
{
    const double h = 1e-6;
    Point2d u1, u2, v1, v2;
    if (!lens.project(u - h, v, u1.x, u1.y) || !lens.project(u + h, v, u2.x, u2.y) ||
        !lens.project(u, v - h, v1.x, v1.y) || !lens.project(u, v + h, v2.x, v2.y))
        return Matx22d(lens.fx, 0, 0, lens.fy); // no ray is seen there
    const Point2d byU = (u2 - u1) * (0.5 / h), byV = (v2 - v1) * (0.5 / h);
    return Matx22d(byU.x, byV.x, byU.y, byV.y);
}

DisplacementField::DisplacementField(const RollingShutterCamera& camera, const std::vector<Point2d>& seen)
    : headingSine(std::sin(camera.heading)), headingCosine(std::cos(camera.heading))
{
    const Lens<double> lens(camera);
    const Matx33d toCamera = camera.uprightRotation.t();
    std::vector<Point2d> pixels;
    for (int i = 0; i < ROWS; i++)
        for (int j = 0; j < COLUMNS; j++)
            pixels.push_back(Point2d((j + 0.5) / COLUMNS * camera.imageSize.width - 0.5,
                                     (i + 0.5) / ROWS * camera.imageSize.height - 0.5));
    const std::vector<Vec3d> rays = bearingsOf(camera, camera.uprightRotation, pixels);
    for (int k = 0; k < POINTS; k++)
    {
        const Vec3d& bearing = rays[k];
        const double z = std::max(bearing[2], IN_FRONT); // never behind a camera that looks steeply up or down
        Point& p = points[k];
        p.pixel = pixels[k];
        p.x = bearing[0] / z;
        p.y = bearing[1] / z;
        p.z = bearing[2];
        p.time = camera.rowTime(pixels[k]);
        const Vec3d q = toCamera * Vec3d(p.x, p.y, 1);
        const double depth = std::max(q[2], IN_FRONT), u = q[0] / depth, v = q[1] / depth;
        p.toPixels = byRay(lens, u, v) *
                     Matx22d(toCamera(0, 0) - u * toCamera(2, 0), toCamera(0, 1) - u * toCamera(2, 1),
                             toCamera(1, 0) - v * toCamera(2, 0), toCamera(1, 1) - v * toCamera(2, 1)) *
                     (1 / depth);
    }
    weigh(seen);
}

// As often as something is seen nearest to a point, and once more: what isn't seen may still be there.
void DisplacementField::weigh(const std::vector<Point2d>& seen)
{
    Vec<double, POINTS> count = Vec<double, POINTS>::all(1);
    for (size_t i = 0; i < seen.size(); i++)
    {
        double least = DBL_MAX;
        int nearest = 0;
        for (int k = 0; k < POINTS; k++)
        {
            const double dx = points[k].x - seen[i].x, dy = points[k].y - seen[i].y, distance2 = dx * dx + dy * dy;
            nearest = distance2 < least ? k : nearest;
            least = std::min(least, distance2);
        }
        count[nearest]++;
    }
    for (int k = 0; k < POINTS; k++)
    {
        points[k].weight = count[k] * POINTS / double(POINTS + seen.size());
        points[k].t = points[k].time * points[k].weight;
    }
}

namespace {

// Scaled inverse depth of the nearest plane at a point and its derivatives.
struct NearestPlane
{
    double w, byB, byD, byLambda, byG;

    NearestPlane(const Model& m, double G, double x, double y) : w(0), byB(0), byD(0), byLambda(0), byG(0)
    {
        const double sign = m.direction < 0 ? -1 : 1, wall = m[P_D] - m[P_B] * x;
        const double left = sign * wall, right = -m[P_LAMBDA] * left, road = sign * G * y;
        if (left > 0 && left >= right && left >= road)
        {
            w = wall;
            byB = -x;
            byD = 1;
        }
        else if (right > 0 && right >= road)
        {
            w = -m[P_LAMBDA] * wall;
            byB = m[P_LAMBDA] * x;
            byD = -m[P_LAMBDA];
            byLambda = -wall;
        }
        else if (road > 0)
        {
            w = G * y;
            byG = y;
        }
    }
};

} // namespace

void DisplacementField::displacement(const Model& m, double G, Values& values) const
{
    for (int k = 0; k < POINTS; k++)
    {
        const Point& p = points[k];
        const double w = NearestPlane(m, G, p.x, p.y).w;
        const Vec2d moved = p.byAlpha() * m[P_ALPHA] + p.byInverseDepth(headingSine, headingCosine) * w;
        values[2 * k] = moved[0];
        values[2 * k + 1] = moved[1];
    }
}

void DisplacementField::variance(const Model& m, double G, double varianceG,
                                 const Matx<double, PARAMETERS, PARAMETERS>& C, Variances& values) const
{
    for (int k = 0; k < POINTS; k++)
    {
        const Point& p = points[k];
        const NearestPlane plane(m, G, p.x, p.y);
        const Vec2d turned = p.byAlpha(), moved = p.byInverseDepth(headingSine, headingCosine);
        const double j[4] = {0, plane.byB, plane.byD, plane.byLambda};
        double vw = plane.byG * plane.byG * varianceG, cross = 0;
        for (int a = 1; a < 4; a++)
        {
            cross += C(P_ALPHA, a) * j[a];
            for (int b = 1; b < 4; b++)
                vw += j[a] * C(a, b) * j[b];
        }
        const double va = C(P_ALPHA, P_ALPHA);
        values[k] = std::max(0., turned.dot(turned) * va + 2 * turned.dot(moved) * cross + moved.dot(moved) * vw);
    }
}

// By a rotation vector.
Point2d DisplacementField::byTurn(const Point& point, const Vec3d& turn) const
{
    const double x = point.x, y = point.y;
    const Vec2d moved = point.toPixels * Vec2d(-x * y * turn[0] + (1 + x * x) * turn[1] - y * turn[2],
                                               -(1 + y * y) * turn[0] + x * y * turn[1] + x * turn[2]);
    return Point2d(moved[0], moved[1]);
}

void DisplacementField::addTilt(const RowTilt& tilt, Values& values) const
{
    for (int k = 0; k < POINTS; k++)
    {
        const Point2d added = byTurn(points[k], tilt.vector(points[k].time)) * points[k].weight;
        values[2 * k] += added.x;
        values[2 * k + 1] += added.y;
    }
}

void DisplacementField::addTiltVariance(double pitchRateSigma, double rollRateSigma, Variances& values) const
{
    for (int k = 0; k < POINTS; k++)
    {
        const Point2d byPitch = byTurn(points[k], Vec3d(-pitchRateSigma * points[k].t, 0, 0)),
                      byRoll = byTurn(points[k], Vec3d(0, 0, rollRateSigma * points[k].t));
        values[k] += byPitch.dot(byPitch) + byRoll.dot(byRoll);
    }
}

double DisplacementField::meanDistance(const Values& a, const Values& b, const Variances& variance)
{
    const double ofMean = 2 / CV_PI; // the mean of a normal deviate's magnitude, squared, over its variance
    double sum = 0;
    for (int k = 0; k < POINTS; k++)
    {
        const double dx = a[2 * k] - b[2 * k], dy = a[2 * k + 1] - b[2 * k + 1];
        sum += std::sqrt(dx * dx + dy * dy + ofMean * variance[k]);
    }
    return sum / POINTS;
}

double DisplacementField::probabilityWorse(double corrected, double residual)
{
    const double sigma = residual / std::sqrt(2 / CV_PI);
    return 0.5 * std::erfc(corrected / (2 * std::sqrt(2.) * std::max(sigma, DBL_MIN)));
}

int DisplacementField::mainMotion(const Model& model, double G) const
{
    Model turning, moving = model;
    turning[P_ALPHA] = model[P_ALPHA];
    moving[P_ALPHA] = 0;
    Values byTurning, byMoving;
    displacement(turning, 0, byTurning);
    displacement(moving, G, byMoving);
    const Variances exact;
    const double turn = meanDistance(byTurning, Values(), exact), move = meanDistance(byMoving, Values(), exact);
    if (turn + move == 0)
        return MODEL_NONE;
    return move < NEXT_TO_NOTHING * turn ? MODEL_1LA : turn < NEXT_TO_NOTHING * move ? MODEL_3LA : MODEL_4LA;
}

}} // namespace cv::rsackermann
