// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_TEST_RSACKERMANN_SIMULATOR_HPP
#define OPENCV_TEST_RSACKERMANN_SIMULATOR_HPP

#include <limits>
#include <functional>
#include "test_metric_motion.hpp"
#include "test_lens_models.hpp"
#include "test_random.hpp"
#include "test_rotation_curve.hpp"
#include "opencv2/rsackermann/solvers.hpp"

namespace opencv_test {

/** A rolling-shutter camera in a street, by three-dimensional geometry: the truth of the tests.

Nothing here uses the closed forms of the library: the motion is integrated numerically, points are projected by root
finding on the row, depths come from intersections of rays and planes. All points are in the upright frame (gravity
along +y, optical axis projected to the horizontal along +z).
*/
namespace simulation {

//! The car's motion, circular but for a change of the yaw rate; time is row time, 0 at the reference row.
struct Drive
{
    double yaw;                           // radians per unit of time, positive to the right
    double speed;                         // length per unit of time, negative in reverse
    double heading;                       // radians from the optical axis to the forward direction at time 0
    double yawChange;                     // of yaw per unit of time
    double pitch;                         // radians per unit of time, downward
    double roll;                          // the same, clockwise seen from behind
    double lever = 0;                     // length from the axle that moves straight ahead to the camera
    std::function<Vec3d(double)> shaking; // instead of these: angles of roll, pitch and yaw since time 0
    std::function<Vec3d(double)> curve;   // and then by a rotation vector

    Drive() : yaw(0), speed(0), heading(0), yawChange(0), pitch(0), roll(0) {}
    Drive(double yaw_, double speed_, double heading_)
        : yaw(yaw_), speed(speed_), heading(heading_), yawChange(0), pitch(0), roll(0)
    {
    }

    //! Radians to the right from time 0.
    double turned(double t) const { return t * (yaw + 0.5 * yawChange * t); }

    //! Position at a time: five-point Gauss-Legendre quadrature of the velocity, of order 10.
    Vec3d position(double t) const
    {
        static const double node[] = {0, 0.53846931010568309104, 0.90617984593866399280};
        static const double weight[] = {0.56888888888888888889, 0.47862867049936646804, 0.23692688505618908751};
        Vec3d sum;
        for (int i = -2; i <= 2; i++)
        {
            const double at = 0.5 * t * (1 + (i < 0 ? -1 : 1) * node[std::abs(i)]);
            const double angle = heading + turned(at);
            sum += weight[std::abs(i)] * Vec3d(std::sin(angle), 0, std::cos(angle));
        }
        const double now = heading + turned(t), start = heading;
        const Vec3d aside(std::sin(now) - std::sin(start), 0, std::cos(now) - std::cos(start));
        return 0.5 * t * speed * sum + lever * aside;
    }

    //! A direction in the camera at time t as one in the camera at time 0.
    Vec3d turn(const Vec3d& inCamera, double t) const
    {
        const Vec3d d = curved(inCamera, t, 1);
        // A camera that has pitched down sees what is ahead further up, one that has rolled clockwise sees it turned
        // the other way round.
        const Vec3d a = tilted(t);
        const double cp = std::cos(a[1]), sp = std::sin(a[1]), cr = std::cos(a[0]), sr = std::sin(a[0]);
        const Vec3d level(d[0], cp * d[1] + sp * d[2], cp * d[2] - sp * d[1]);
        return rotated(Vec3d(cr * level[0] - sr * level[1], sr * level[0] + cr * level[1], level[2]), turned(t) + a[2]);
    }

    //! A point at rest as the camera at time t has it.
    Vec3d toCamera(const Vec3d& P, double t) const
    {
        const Vec3d a = tilted(t), ahead = rotated(P - position(t), -turned(t) - a[2]);
        const double cp = std::cos(a[1]), sp = std::sin(a[1]), cr = std::cos(a[0]), sr = std::sin(a[0]);
        const Vec3d q(cr * ahead[0] + sr * ahead[1], cr * ahead[1] - sr * ahead[0], ahead[2]);
        return curved(Vec3d(q[0], cp * q[1] - sp * q[2], cp * q[2] + sp * q[1]), t, -1);
    }

    //! The motion's turns beside the yaw.
    void setTilt(const cv::rsackermann::RollingShutterCamera& camera, const cv::rsackermann::AckermannMotion& m)
    {
        pitch = m.pitchRate;
        roll = m.rollRate;
        curve = rotationCurveOf(camera, m);
    }

private:
    Vec3d curved(const Vec3d& d, double t, int sign) const
    {
        if (!curve)
            return d;
        Matx33d R;
        cv::Rodrigues(curve(t) * sign, R);
        return R * d;
    }

    //! Roll and pitch since time 0, and the yaw beyond that of the car.
    Vec3d tilted(double t) const { return shaking ? shaking(t) : Vec3d(roll * t, pitch * t, 0); }

    static Vec3d rotated(const Vec3d& d, double angle)
    {
        const double c = std::cos(angle), s = std::sin(angle);
        return Vec3d(c * d[0] + s * d[2], d[1], c * d[2] - s * d[0]);
    }
};

//! Planes that a ray can hit.
enum Surface { NOTHING = 0, LEFT = 1, RIGHT = 2, ROAD = 3 };

//! Two walls and a road, each the points P with normal . P = 1; a zero normal is an absent plane.
struct Street
{
    Vec3d normal[4];

    Street() {}

    //! Distances to the planes, 0: absent. The walls run along the direction (radians to the right of the optical
    //! axis).
    Street(double left, double right, double height, double direction)
    {
        const Vec3d toTheRight(std::cos(direction), 0, -std::sin(direction));
        if (left > 0)
            normal[LEFT] = toTheRight * (-1 / left);
        if (right > 0)
            normal[RIGHT] = toTheRight * (1 / right);
        if (height > 0)
            normal[ROAD] = Vec3d(0, 1 / height, 0);
    }

    //! Distance along the ray to a plane in lengths of the direction; infinity if the ray doesn't hit it.
    double distance(Surface plane, const Vec3d& origin, const Vec3d& direction) const
    {
        const double rate = normal[plane].dot(direction), rest = 1 - normal[plane].dot(origin);
        return rate * rest > 0 ? rest / rate : std::numeric_limits<double>::infinity();
    }

    //! The first plane that the ray hits.
    Surface first(const Vec3d& origin, const Vec3d& direction) const
    {
        Surface nearest = NOTHING;
        double best = std::numeric_limits<double>::infinity();
        for (int i = LEFT; i <= ROAD; i++)
        {
            const double d = distance(Surface(i), origin, direction);
            if (d < best)
            {
                best = d;
                nearest = Surface(i);
            }
        }
        return nearest;
    }
};

//! A camera that moves along a street.
class Simulator
{
public:
    Simulator(const cv::rsackermann::RollingShutterCamera& camera_, const Drive& drive_, const Street& street_)
        : camera(camera_), drive(drive_), street(street_)
    {
    }

    //! Metric values; see AckermannMotion::fromMetric.
    static Simulator fromMetric(const cv::rsackermann::RollingShutterCamera& camera, double yawRate, double speed,
                                double left, double right, double wallDirection)
    {
        const double unit = camera.cameraMatrix(1, 1) * camera.lineDelay;
        return Simulator(camera, Drive(yawRate * unit, speed * unit, camera.heading),
                         Street(left, right, camera.height, wallDirection));
    }

    //! What a motion says about the camera and the scene; at rest if the motion isn't OK.
    static Simulator fromMotion(const cv::rsackermann::RollingShutterCamera& camera,
                                const cv::rsackermann::AckermannMotion& m)
    {
        if (m.status != cv::rsackermann::MOTION_OK)
            return Simulator(camera, Drive(), Street());
        Street street;
        street.normal[LEFT] = Vec3d(-m.wallSlope, 0, m.wallOffset) * double(m.direction);
        street.normal[RIGHT] = Vec3d(m.wallSlope, 0, -m.wallOffset) * (m.wallRatio * m.direction);
        street.normal[ROAD] = Vec3d(0, m.roadSlope, 0) * double(m.direction);
        Drive drive(2 * m.alpha, m.direction, camera.heading);
        drive.setTilt(camera, m);
        return Simulator(camera, drive, street);
    }

    double rowTime(double line) const
    {
        const bool reversed = camera.scanDirection == cv::rsackermann::SCAN_BOTTOM_TO_TOP ||
                              camera.scanDirection == cv::rsackermann::SCAN_RIGHT_TO_LEFT;
        return (reversed ? -1 : 1) * (line - camera.referenceRow) / camera.cameraMatrix(1, 1);
    }

    double time(const Point2d& pixel) const { return rowTime(scansRows() ? pixel.y : pixel.x); }

    //! Direction of a raw pixel in the upright frame of the moving camera.
    Vec3d bearing(const Point2d& pixel) const
    {
        const Matx33d& K = camera.cameraMatrix;
        Vec3d ray((pixel.x - K(0, 2)) / K(0, 0), (pixel.y - K(1, 2)) / K(1, 1), 1);
        if (!camera.distCoeffs.empty())
        {
            // Newton's method on the lens model that lens() evaluates
            const Point2d want(ray[0], ray[1]);
            const double h = 1e-6;
            Point2d p = want;
            for (int i = 0; i < 20; i++)
            {
                std::vector<Point2d> f = {p, p + Point2d(h, 0), p - Point2d(h, 0), p + Point2d(0, h),
                                          p - Point2d(0, h)};
                lens(f);
                const Point2d error = f[0] - want, dx = (f[1] - f[2]) * (0.5 / h), dy = (f[3] - f[4]) * (0.5 / h);
                const double det = dx.x * dy.y - dx.y * dy.x;
                p -= Point2d(error.x * dy.y - error.y * dy.x, dx.x * error.y - dx.y * error.x) * (1 / det);
                if (cv::norm(error) < 1e-12)
                    break;
            }
            ray = Vec3d(p.x, p.y, 1);
        }
        return camera.uprightRotation * ray;
    }

    //! Raw pixel of a point in the moving camera's upright frame.
    bool pixelOf(const Vec3d& inCamera, Point2d& pixel) const
    {
        const Vec3d P = camera.uprightRotation.t() * inCamera;
        if (!(P[2] > 1e-9))
            return false;
        std::vector<Point2d> q(1, Point2d(P[0] / P[2], P[1] / P[2]));
        lens(q);
        const Matx33d& K = camera.cameraMatrix;
        pixel = Point2d(K(0, 0) * q[0].x + K(0, 2), K(1, 1) * q[0].y + K(1, 2));
        return true;
    }

    //! Pixel of a point at rest for a camera that stands still at the pose of a time.
    bool projectAt(const Vec3d& P, double t, Point2d& pixel) const { return pixelOf(drive.toCamera(P, t), pixel); }

    //! Pixel in the rolling-shutter image: bisection on the line whose own instant shows the point there.
    bool project(const Vec3d& P, Point2d& pixel) const
    {
        double low = -1, high = scansRows() ? camera.imageSize.height : camera.imageSize.width;
        double atLow, atHigh;
        if (!mismatch(P, low, atLow) || !mismatch(P, high, atHigh) || atLow < 0 || atHigh > 0)
            return false;
        for (int i = 0; i < 60; i++)
        {
            const double middle = 0.5 * (low + high);
            double at;
            if (!mismatch(P, middle, at))
                return false;
            (at > 0 ? low : high) = middle;
        }
        return projectAt(P, rowTime(0.5 * (low + high)), pixel) && inside(pixel);
    }

    bool inside(const Point2d& pixel) const
    {
        return pixel.x >= 0 && pixel.y >= 0 && pixel.x <= camera.imageSize.width - 1 &&
               pixel.y <= camera.imageSize.height - 1;
    }

    //! Plane that a raw pixel shows.
    Surface surface(const Point2d& pixel) const { return street.first(drive.position(time(pixel)), worldRay(pixel)); }

    //! Point that a raw pixel shows if it lies on the plane; at infinity (false) P is its direction.
    bool locate(const Point2d& pixel, Surface plane, Vec3d& P) const
    {
        const Vec3d origin = drive.position(time(pixel)), ray = worldRay(pixel);
        const double distance = street.distance(plane, origin, ray);
        const bool finite = plane != NOTHING && distance < 1e9;
        P = finite ? Vec3d(origin + ray * distance) : ray;
        return finite;
    }

    //! Where a global shutter at the reference row would show what a raw pixel shows.
    bool globalPixel(const Point2d& pixel, Point2d& global) const
    {
        Vec3d P;
        locate(pixel, surface(pixel), P);
        return pixelOf(P, global);
    }

    //! Pixels by which the compensated columns of both ends of a segment differ, if it lies on the plane.
    double residual(const Vec4d& segment, Surface plane) const
    {
        Vec3d P, Q;
        locate(Point2d(segment[0], segment[1]), plane, P);
        locate(Point2d(segment[2], segment[3]), plane, Q);
        return camera.cameraMatrix(0, 0) * (P[0] / P[2] - Q[0] / Q[2]);
    }

    //! Mean pixels between the global-shutter pixels of another simulation and the true ones, over the raw pixels of
    //! walls.
    double meanDisplacement(const Simulator& other) const
    {
        double sum = 0;
        int n = 0;
        for (int y = 0; y < 20; y++)
            for (int x = 0; x < 20; x++)
            {
                const Point2d pixel((x + 0.5) / 20 * (camera.imageSize.width - 1),
                                    (y + 0.5) / 20 * (camera.imageSize.height - 1));
                const Surface plane = surface(pixel);
                Point2d a, b;
                if ((plane != LEFT && plane != RIGHT) || !globalPixel(pixel, a) || !other.globalPixel(pixel, b))
                    continue;
                sum += cv::norm(a - b);
                n++;
            }
        return n ? sum / n : 0;
    }

    //! Mean pixels by which the rolling shutter displaces the walls.
    double meanDisplacement() const { return meanDisplacement(Simulator(camera, Drive(), Street())); }

    cv::rsackermann::RollingShutterCamera camera;
    Drive drive;
    Street street;

private:
    bool scansRows() const
    {
        return camera.scanDirection == cv::rsackermann::SCAN_TOP_TO_BOTTOM ||
               camera.scanDirection == cv::rsackermann::SCAN_BOTTOM_TO_TOP;
    }

    Vec3d worldRay(const Point2d& pixel) const { return drive.turn(bearing(pixel), time(pixel)); }

    bool mismatch(const Vec3d& P, double line, double& difference) const
    {
        Point2d pixel;
        if (!projectAt(P, rowTime(line), pixel))
            return false;
        difference = (scansRows() ? pixel.y : pixel.x) - line;
        return true;
    }

    //! The lens on normalised coordinates, by OpenCV's projection functions.
    void lens(std::vector<Point2d>& points) const
    {
        if (camera.distCoeffs.empty())
            return;
        std::vector<Point3d> object;
        for (size_t i = 0; i < points.size(); i++)
            object.push_back(Point3d(points[i].x, points[i].y, 1));
        const Mat zero = Mat::zeros(3, 1, CV_64F);
        if (camera.lensModel == cv::rsackermann::LENS_FISHEYE)
            cv::fisheye::projectPoints(object, points, zero, zero, Matx33d::eye(), camera.distCoeffs);
        else
            cv::projectPoints(object, zero, zero, Matx33d::eye(), camera.distCoeffs, points);
    }
};

//! Which segments to make.
struct SegmentOptions
{
    SegmentOptions() : count(60), inlierRatio(1), noise(0), minLength(40), maxLength(150), maxSlant(0.3) {}
    int count;          // segments in all
    double inlierRatio; // share of images of vertical lines
    double noise;       // pixels, standard deviation at every end
    double minLength;   // pixels
    double maxLength;   // pixels
    double maxSlant;    // largest tangent of the angle between an outlier and the vertical
};

//! Segments with the plane on which each lies; NOTHING for outliers.
struct Segments
{
    Mat ends; // N x 4, CV_64F
    std::vector<Surface> truth;

    Vec4d at(int i) const { return *ends.ptr<Vec4d>(i); }
};

//! The rolling-shutter image of a vertical line on a wall, with its midpoint near a random pixel.
inline bool randomVertical(const Simulator& simulator, const SegmentOptions& options, RNG& rng, Vec4d& segment,
                           Surface& plane)
{
    const Size size = simulator.camera.imageSize;
    const Point2d middle = uniformPoint(rng, Point2d(0, 0), Point2d(size.width - 1, size.height - 1));
    plane = simulator.surface(middle);
    Vec3d P;
    if ((plane != LEFT && plane != RIGHT) || !simulator.locate(middle, plane, P))
        return false;
    const double half =
        0.5 * rng.uniform(options.minLength, options.maxLength) / simulator.camera.cameraMatrix(1, 1) * cv::norm(P);
    Point2d top, bottom;
    if (!simulator.project(P - Vec3d(0, half, 0), top) || !simulator.project(P + Vec3d(0, half, 0), bottom) ||
        simulator.surface(top) != plane || simulator.surface(bottom) != plane ||
        cv::norm(top - bottom) < options.minLength)
        return false;
    segment = Vec4d(top.x, top.y, bottom.x, bottom.y);
    return true;
}

//! Vertical lines on the walls, noise and outliers in a random order.
inline Segments randomSegments(const Simulator& simulator, const SegmentOptions& options, RNG& rng)
{
    const Size size = simulator.camera.imageSize;
    Segments result;
    result.ends.create(options.count, 4, CV_64F);
    result.truth.assign(options.count, NOTHING);
    const int inliers = cvRound(options.count * options.inlierRatio);
    std::vector<int> order(options.count);
    for (int i = 0; i < options.count; i++)
        order[i] = i;
    for (int i = options.count - 1; i > 0; i--)
        std::swap(order[i], order[rng.uniform(0, i + 1)]);

    for (int k = 0; k < options.count; k++)
    {
        const int i = order[k];
        Vec4d& segment = *result.ends.ptr<Vec4d>(i);
        if (k < inliers)
        {
            bool found = false;
            for (int tries = 0; tries < 100000 && !found; tries++)
                found = randomVertical(simulator, options, rng, segment, result.truth[i]);
            CV_Assert(found && "the camera sees no wall");
        }
        else
        {
            const double height = 0.5 * rng.uniform(options.minLength, options.maxLength);
            const double width = height * rng.uniform(-options.maxSlant, options.maxSlant);
            const double x = rng.uniform(std::abs(width), size.width - 1 - std::abs(width)),
                         y = rng.uniform(height, size.height - 1 - height);
            segment = Vec4d(x - width, y - height, x + width, y + height);
        }
        for (int j = 0; j < 4; j++)
            segment[j] += rng.gaussian(options.noise);
        if (rng.uniform(0, 2))
            segment = Vec4d(segment[2], segment[3], segment[0], segment[1]);
    }
    return result;
}

//! The two ends of a segment as the minimal solvers take them.
inline cv::rsackermann::VerticalSegment toVerticalSegment(const Simulator& simulator, const Vec4d& segment)
{
    const Point2d u(segment[0], segment[1]), v(segment[2], segment[3]);
    const Vec3d a = simulator.bearing(u), b = simulator.bearing(v);
    cv::rsackermann::VerticalSegment result;
    result.u = cv::rsackermann::HorizontalBearing(a[0], a[2]);
    result.timeU = simulator.time(u);
    result.v = cv::rsackermann::HorizontalBearing(b[0], b[2]);
    result.timeV = simulator.time(v);
    return result;
}

//! The camera of the paper's experiments: 640 x 380, f = 816, height 1.2 m, 30 frames/s of which 40 % is read-out.
inline cv::rsackermann::RollingShutterCamera paperCamera()
{
    cv::rsackermann::RollingShutterCamera camera =
        cv::rsackermann::RollingShutterCamera::fromFocal(Size(640, 380), 816);
    camera.setRollPitch(0, 0);
    camera.lineDelay = 0.4 / 30 / 380;
    camera.height = 1.2;
    return camera;
}

} // namespace simulation
} // namespace opencv_test

#endif // OPENCV_TEST_RSACKERMANN_SIMULATOR_HPP
