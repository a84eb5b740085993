// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../camera/rays.hpp"
#include "../compensation.hpp"
#include "flow_fit.hpp"

namespace cv {
namespace rsackermann {

static const double PIXEL_SCALE = 1.5;
static const double DEPENDENCE = 5;
static const double PITCH_SIGMA = 0.5 * CV_PI / 180, ROLL_SIGMA = 0.3 * CV_PI / 180;
static const int ITERATIONS = 6;          // at each scale

namespace {

enum { F_PITCH = DRIVE_VALUES, F_ROLL, F_VALUES };

typedef Vec<double, F_VALUES> Unknowns;
typedef Matx<double, F_VALUES, F_VALUES> Information;

// A pair of points as upright bearings with z = 1, and the row times at which they were seen.
struct Sight
{
    Point2d before, now;
    double timeBefore, timeNow;
};

std::vector<Sight> makeSights(const RollingShutterCamera& camera, const std::vector<PointPair>& pairs, double seconds)
{
    std::vector<Point2d> pixels, rays;
    for (size_t i = 0; i < pairs.size(); i++)
    {
        pixels.push_back(pairs[i].before);
        pixels.push_back(pairs[i].now);
    }
    undistortedRays(camera, pixels, rays);
    std::vector<Sight> sights;
    for (size_t i = 0; i < pairs.size(); i++)
    {
        const Vec3d a = camera.uprightRotation * Vec3d(rays[2 * i].x, rays[2 * i].y, 1);
        const Vec3d b = camera.uprightRotation * Vec3d(rays[2 * i + 1].x, rays[2 * i + 1].y, 1);
        if (!(a[2] > 0.1 && b[2] > 0.1))
            continue;
        const Sight s = {Point2d(a[0] / a[2], a[1] / a[2]), Point2d(b[0] / b[2], b[1] / b[2]),
                         camera.rowTime(pixels[2 * i]) - seconds / camera.secondsPerUnitTime(), camera.rowTime(pixels[2 * i + 1])};
        sights.push_back(s);
    }
    return sights;
}

class FlowProblem
{
public:
    FlowProblem(const RollingShutterCamera& camera, const std::vector<Sight>& sights_, const DriveState& prediction)
        : sights(sights_), heading(camera.heading), unit(camera.secondsPerUnitTime()), focal(camera.cameraMatrix(0, 0))
    {
        for (int i = 0; i < DRIVE_VALUES; i++)
            expected[i] = prediction.value[i];
        const DriveMatrix known = prediction.covariance.inv(DECOMP_CHOLESKY);
        for (int i = 0; i < DRIVE_VALUES; i++)
            for (int j = 0; j < DRIVE_VALUES; j++)
                prior(i, j) = known(i, j);
        prior(F_PITCH, F_PITCH) = 1 / (PITCH_SIGMA * PITCH_SIGMA);
        prior(F_ROLL, F_ROLL) = 1 / (ROLL_SIGMA * ROLL_SIGMA);
    }

    // By how much a point was elsewhere in the image before, pixels; the derivatives are those of the motion to first order.
    Point2d residual(const Sight& s, const Unknowns& u, Unknowns* byX, Unknowns* byY) const
    {
        const double alpha = u[DRIVE_YAW_RATE] * unit / 2, length = u[DRIVE_SPEED] * unit;
        const double cosD = std::cos(u[DRIVE_DIRECTION]), sinD = std::sin(u[DRIVE_DIRECTION]);
        const RowMotion now(alpha, heading, s.timeNow), before(alpha, heading, s.timeBefore);
        const double X = now.c * s.now.x + now.s, Z = now.c - now.s * s.now.x, Y = s.now.y;
        const double placeX = now.tau * now.s2, placeZ = now.tau * now.c2;
        // The nearest plane.
        const double across = sinD * Z - cosD * X, passed = length * (sinD * placeZ - cosD * placeX);
        const double planes[3] = {u[DRIVE_LEFT] * across / std::max(0.1, 1 - u[DRIVE_LEFT] * passed),
                                  -u[DRIVE_RIGHT] * across / std::max(0.1, 1 + u[DRIVE_RIGHT] * passed), u[DRIVE_ROAD] * Y};
        const int plane = int(std::max_element(planes, planes + 3) - planes);
        const double w = length * std::max(0., planes[plane]);
        const double x = X + w * (placeX - before.tau * before.s2), z = Z + w * (placeZ - before.tau * before.c2);
        const double turnedX = before.c * x - before.s * z, turnedZ = before.s * x + before.c * z;
        if (!(turnedZ > 0.05))
            return Point2d(1e3, 1e3);
        const double px = turnedX / turnedZ, py = Y / turnedZ;
        const double rx = px + px * py * u[F_PITCH] - py * u[F_ROLL] - s.before.x, ry = py + (1 + py * py) * u[F_PITCH] + px * u[F_ROLL] - s.before.y;
        if (byX)
        {
            const double mx = (s.now.x + s.before.x) / 2, my = (s.now.y + s.before.y) / 2, f = focal * (s.timeNow - s.timeBefore);
            const double dx = f * (heading.s - mx * heading.c), dy = -f * my * heading.c, turn = f * unit;
            Unknowns byW;
            const double side = plane == 1 ? -1 : 1, wall = u[plane == 1 ? DRIVE_RIGHT : DRIVE_LEFT], l = side * (sinD - cosD * mx);
            if (planes[plane] > 0)
            {
                byW[DRIVE_SPEED] = unit * (plane == 2 ? u[DRIVE_ROAD] * my : wall * l);
                if (plane == 2)
                    byW[DRIVE_ROAD] = length * my;
                else
                {
                    byW[plane == 1 ? DRIVE_RIGHT : DRIVE_LEFT] = length * l;
                    byW[DRIVE_DIRECTION] = length * wall * side * (cosD + sinD * mx);
                }
            }
            *byX = byW * dx;
            *byY = byW * dy;
            (*byX)[DRIVE_YAW_RATE] = turn * (1 + mx * mx);
            (*byY)[DRIVE_YAW_RATE] = turn * mx * my;
            (*byX)[F_PITCH] = focal * mx * my;
            (*byY)[F_PITCH] = focal * (1 + my * my);
            (*byX)[F_ROLL] = -focal * my;
            (*byY)[F_ROLL] = focal * mx;
        }
        return Point2d(focal * rx, focal * ry);
    }

    double cost(const Unknowns& u, double scale) const
    {
        double sum = 0;
        for (size_t i = 0; i < sights.size(); i++)
        {
            const Point2d r = residual(sights[i], u, 0, 0);
            sum += std::log1p(r.dot(r) / (scale * scale));
        }
        const Unknowns d = u - expected;
        return sum * scale * scale / (PIXEL_SCALE * PIXEL_SCALE) / DEPENDENCE + d.dot(prior * d);
    }

    // Gauss-Newton with Cauchy's loss. Returns the cost; information receives the inverse covariance.
    double refine(double scale, Unknowns& u, Information& information) const
    {
        double before = cost(u, scale);
        for (int k = 0; k < ITERATIONS; k++)
        {
            Unknowns gradient = prior * (u - expected);
            information = prior;
            for (size_t i = 0; i < sights.size(); i++)
            {
                Unknowns jx, jy;
                const Point2d r = residual(sights[i], u, &jx, &jy);
                const double weight = 1 / (1 + r.dot(r) / (scale * scale)) / (PIXEL_SCALE * PIXEL_SCALE) / DEPENDENCE;
                gradient += weight * (r.x * jx + r.y * jy);
                for (int a = 0; a < F_VALUES; a++)
                    for (int b = 0; b <= a; b++)
                        information(a, b) += weight * (jx[a] * jx[b] + jy[a] * jy[b]);
            }
            for (int a = 0; a < F_VALUES; a++)
                for (int b = 0; b < a; b++)
                    information(b, a) = information(a, b);
            Unknowns step = information.solve(gradient, DECOMP_CHOLESKY);
            bool better = false;
            for (int half = 0; half < 4 && !better; half++, step = step * 0.5)
            {
                Unknowns next = u - step;
                next[DRIVE_LEFT] = std::max(next[DRIVE_LEFT], 0.);
                next[DRIVE_RIGHT] = std::max(next[DRIVE_RIGHT], 0.);
                next[DRIVE_ROAD] = std::max(next[DRIVE_ROAD], 0.);
                const double after = cost(next, scale);
                if (after < before)
                {
                    better = before - after > 1e-3;
                    before = after;
                    u = next;
                    break;
                }
            }
            if (!better)
                break;
        }
        return before;
    }

    const std::vector<Sight>& sights;

private:
    Heading heading;
    double unit, focal;
    Unknowns expected;
    Information prior;
};

// Refines a start with ever less tolerance.
void refineFrom(const FlowProblem& problem, Unknowns u, FlowFit& best, Unknowns& found)
{
    const double scales[] = {8, 3, 1};
    Information information;
    double cost = 0;
    for (int i = 0; i < 3; i++)
        cost = problem.refine(scales[i] * PIXEL_SCALE, u, information);
    if (!(cost < best.cost))
        return;
    best.cost = cost;
    found = u;
    const Information covariance = information.inv(DECOMP_CHOLESKY);
    for (int a = 0; a < DRIVE_VALUES; a++)
    {
        best.state.value[a] = u[a];
        for (int b = 0; b < DRIVE_VALUES; b++)
            best.state.covariance(a, b) = covariance(a, b);
    }
}

// What the points say of the correction: those that don't move with the scene say nothing.
void expect(const FlowProblem& problem, const Unknowns& found, double focal, FlowFit& fit)
{
    const double agrees = 4 * PIXEL_SCALE;
    size_t count = 0;
    fit.expectedRaw = fit.expectedLeft = 0;
    for (size_t i = 0; i < problem.sights.size(); i++)
    {
        const Sight& s = problem.sights[i];
        const double length = norm(problem.residual(s, found, 0, 0)), part = std::abs(s.timeNow / (s.timeNow - s.timeBefore));
        if (!(length < agrees))
            continue;
        count++;
        fit.expectedRaw += part * focal * norm(s.now - s.before);
        fit.expectedLeft += part * length;
    }
    fit.explained = problem.sights.empty() ? 0 : double(count) / problem.sights.size();
    fit.expectedRaw /= std::max<size_t>(count, 1);
    fit.expectedLeft /= std::max<size_t>(count, 1);
}

} // namespace

FlowFit fitFlow(const RollingShutterCamera& camera, const std::vector<PointPair>& pairs, double seconds, const DriveState& prediction, bool isFirst)
{
    const double enough = 0.5; // of the points
    const std::vector<Sight> sights = makeSights(camera, pairs, seconds);
    const FlowProblem problem(camera, sights, prediction);
    FlowFit best(prediction);
    Unknowns start, found;
    for (int i = 0; i < DRIVE_VALUES; i++)
        start[i] = prediction.value[i];
    refineFrom(problem, start, best, found);
    expect(problem, found, camera.cameraMatrix(0, 0), best);
    if (!isFirst && best.explained > enough)
        return best;
    const double speeds[] = {0, 10, 10, -3}, walls[] = {0.1, 0.2, 0.08, 0.1};
    for (int i = 0; i < 4; i++)
    {
        start[DRIVE_SPEED] = speeds[i];
        start[DRIVE_LEFT] = start[DRIVE_RIGHT] = walls[i];
        refineFrom(problem, start, best, found);
    }
    expect(problem, found, camera.cameraMatrix(0, 0), best);
    return best;
}

}} // namespace cv::rsackermann
