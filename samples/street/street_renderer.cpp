// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "street_renderer.hpp"
#include "lens.hpp"
#include "texture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace street {

namespace {

const double HAZE = 150; // metres after which a third of the colour is left

// Rotation whose rows are the axes of the upright frame: y along gravity, z the optical axis made horizontal.
cv::Matx33d uprightFrom(double roll, double pitch)
{
    cv::Vec3d down(std::sin(roll), std::cos(roll) * std::cos(pitch), std::sin(pitch));
    down *= 1 / cv::norm(down);
    cv::Vec3d ahead = cv::Vec3d(0, 0, 1) - down * down[2];
    ahead *= 1 / cv::norm(ahead);
    const cv::Vec3d right = down.cross(ahead);
    return cv::Matx33d(right[0], right[1], right[2], down[0], down[1], down[2], ahead[0], ahead[1], ahead[2]);
}

cv::Vec3d turned(double c, double s, const cv::Vec3d& v)
{
    return cv::Vec3d(c * v[0] + s * v[2], v[1], c * v[2] - s * v[0]);
}

} // namespace

StreetCamera::StreetCamera(const cv::Size& imageSize, double focal, double delay, double metres)
    : size(imageSize), fx(focal), fy(focal), cx((imageSize.width - 1) / 2.), cy((imageSize.height - 1) / 2.),
      lineDelay(delay), scan(0), reference((imageSize.height - 1) / 2.), roll(0), pitch(0), heading(0), height(metres),
      seconds(0)
{
}

cv::Vec3d turnRates(const StreetCamera& camera, double yawRate)
{
    const double step = 1e-5; // of seconds: between rounding and the curvature of the fastest shaking
    const cv::Matx33d mount = uprightFrom(camera.roll, camera.pitch),
                      before = camera.shake.rotation(camera.seconds - step),
                      now = camera.shake.rotation(camera.seconds), after = camera.shake.rotation(camera.seconds + step);
    const cv::Matx33d turn = before.t() * after, twice = turn - turn.t();
    return cv::Vec3d(twice(2, 1), twice(0, 2), twice(1, 0)) * (1 / (4 * step)) +
           (mount * now).t() * cv::Vec3d(0, yawRate, 0);
}

cv::Matx44d viewMatrix(const StreetCamera& camera, const StreetScene& scene)
{
    // doc/theory.md, "Motion": the upright frame of the camera, whose z axis is the optical one made horizontal
    const double c = std::cos(scene.wallDirection), s = std::sin(scene.wallDirection);
    const cv::Matx33d upright(c, 0, s, 0, 1, 0, -s, 0, c); // from the street
    const cv::Matx33d turn =
        (uprightFrom(camera.roll, camera.pitch) * camera.shake.rotation(camera.seconds)).t() * upright;
    const cv::Vec3d shift = turn * cv::Vec3d(-scene.sideways, 0, -scene.travelled);
    return cv::Matx44d(turn(0, 0), turn(0, 1), turn(0, 2), shift[0], //
                       turn(1, 0), turn(1, 1), turn(1, 2), shift[1], //
                       turn(2, 0), turn(2, 1), turn(2, 2), shift[2], //
                       0, 0, 0, 1);
}

StreetScene::StreetScene()
    : yawRate(0), speed(0), left(2.5), right(3), edges{0, 0}, wallDirection(0), travelled(0), sideways(0), seed(0),
      clutter(0), stagger(0), obstacles(0), stains(0), noise(1), frame(0)
{
}

StreetRenderer::StreetRenderer(const StreetCamera& camera, const StreetScene& scene)
    : camera_(camera), scene_(scene), mount_(uprightFrom(camera.roll, camera.pitch)),
      along_(std::sin(scene.wallDirection), 0, std::cos(scene.wallDirection)),
      across_(std::cos(scene.wallDirection), 0, -std::sin(scene.wallDirection)),
      left_(Facade(2 * scene.seed, scene.clutter, 1.05), scene.left, scene.stagger, scene.obstacles, 2 * scene.seed),
      right_(Facade(2 * scene.seed + 1, scene.clutter, 0.85), scene.right, scene.stagger, scene.obstacles,
             2 * scene.seed + 1)
{
    CV_Assert(scene.left >= 0 && scene.right >= 0 && camera.height > 0);
    CV_Assert(scene.stagger >= 0 && scene.obstacles >= 0);
    CV_Assert(camera.scan >= 0 && camera.scan <= 3);
}

double StreetRenderer::secondsAt(double line) const
{
    // doc/theory.md, "Row time"
    const double sign = camera_.scan == 1 || camera_.scan == 3 ? -1 : 1;
    return sign * (line - camera_.reference) * camera_.lineDelay;
}

StreetRenderer::Pose StreetRenderer::poseAt(double seconds) const
{
    // doc/theory.md, "Motion", in metres and seconds
    const double yaw = scene_.yawRate * seconds, half = yaw / 2;
    const double arc = scene_.speed * seconds, chord = std::abs(half) < 1e-8 ? arc : arc * std::sin(half) / half;
    const double direction = half + camera_.heading;
    const Pose pose = {mount_ * camera_.shake.rotation(camera_.seconds + seconds), std::cos(yaw), std::sin(yaw),
                       cv::Vec3d(chord * std::sin(direction), 0, chord * std::cos(direction))};
    return pose;
}

std::vector<StreetRenderer::Pose> StreetRenderer::posesOfLines(bool moving) const
{
    // All of a line is read at one instant.
    std::vector<Pose> poses;
    const int lines = camera_.scan < 2 ? camera_.size.height : camera_.size.width;
    for (int i = 0; i < lines; i++)
        poses.push_back(poseAt(moving ? secondsAt(i) : 0));
    return poses;
}

cv::Vec3d StreetRenderer::uprightRay(const Pose& pose, const cv::Point2d& pixel, bool throughLens) const
{
    cv::Point2d p((pixel.x - camera_.cx) / camera_.fx, (pixel.y - camera_.cy) / camera_.fy);
    if (throughLens)
        p = undistortPoint(camera_.lens, p);
    return pose.upright * cv::Vec3d(p.x, p.y, 1);
}

bool StreetRenderer::project(const Pose& pose, const cv::Vec3d& upright, bool throughLens, cv::Point2d& pixel) const
{
    const cv::Vec3d v = pose.upright.t() * upright;
    if (v[2] <= 1e-9)
        return false;
    cv::Point2d p(v[0] / v[2], v[1] / v[2]);
    if (throughLens)
        p = distortPoint(camera_.lens, p);
    pixel = cv::Point2d(p.x * camera_.fx + camera_.cx, p.y * camera_.fy + camera_.cy);
    return true;
}

StreetRenderer::Hit StreetRenderer::cast(const cv::Vec3d& origin, const cv::Vec3d& ray) const
{
    const double side = across_.dot(origin), sideways = across_.dot(ray);
    const double gap[3] = {-scene_.left - side, scene_.right - side, camera_.height - origin[1]};
    const double rate[3] = {sideways, sideways, ray[1]};
    const bool present[3] = {scene_.left > 0, scene_.right > 0, true};
    Hit hit = {0, 0, {StreetSide::Surface::FRONT, 0}};
    for (int i = 0; i < 3; i++)
    {
        const double distance = gap[i] / rate[i];
        if (present[i] && distance > 0 && distance < 1e9 && (hit.plane == 0 || distance < hit.distance))
        {
            hit.plane = i + 1;
            hit.distance = distance;
        }
    }
    if (scene_.stagger > 0 || scene_.obstacles > 0)
        castUneven(origin, ray, hit);
    return hit;
}

void StreetRenderer::castUneven(const cv::Vec3d& origin, const cv::Vec3d& ray, Hit& hit) const
{
    Hit nearest = {0, std::numeric_limits<double>::infinity(), hit.surface};
    if (ray[1] > 0) // the road goes on behind the planes of the walls
    {
        nearest.plane = 3;
        nearest.distance = (camera_.height - origin[1]) / ray[1];
    }
    if (scene_.left > 0 && left_.cast(placeAt(1, origin), directionAt(1, ray), nearest.distance, nearest.surface))
        nearest.plane = 1;
    if (scene_.right > 0 && right_.cast(placeAt(2, origin), directionAt(2, ray), nearest.distance, nearest.surface))
        nearest.plane = 2;
    if (nearest.plane)
        hit = nearest;
    else // the sky counts as a part of the walls' planes here too, so that the true maps of both kinds of street
         // compare
        hit.surface.kind = StreetSide::Surface::NOTHING;
}

cv::Vec3d StreetRenderer::directionAt(int plane, const cv::Vec3d& v) const
{
    const double side = across_.dot(v);
    return cv::Vec3d(along_.dot(v), plane == 1 ? -side : side, -v[1]);
}

double StreetRenderer::leftEdge() const
{
    return scene_.left > 0 ? scene_.left : scene_.edges[0];
}

cv::Vec3d StreetRenderer::placeAt(int plane, const cv::Vec3d& v) const
{
    const double side = across_.dot(v);
    return cv::Vec3d(along_.dot(v) + scene_.travelled, plane == 1 ? -side - leftEdge() : side - scene_.right,
                     camera_.height - v[1]);
}

cv::Vec3f StreetRenderer::colour(const cv::Vec3d& origin, const cv::Vec3d& ray) const
{
    const double elevation = -ray[1] / std::sqrt(ray[0] * ray[0] + ray[2] * ray[2]);
    const cv::Vec3f sky =
        cv::Vec3f(235, 225, 215) - cv::Vec3f(20, 60, 90) * std::min(1., std::max(0., elevation * 1.5));
    const Hit hit = cast(origin, ray);
    if (!hit.plane)
        return sky;
    const cv::Vec3d place = origin + ray * hit.distance;
    const double metres = hit.distance * cv::norm(ray), footprint = metres / camera_.fx;
    cv::Vec3f paint;
    if (hit.plane == 3)
        paint = sampleRoad(along_.dot(place) + scene_.travelled, across_.dot(place) + leftEdge(),
                           leftEdge() + (scene_.right > 0 ? scene_.right : scene_.edges[1]), footprint);
    else if (!(hit.plane == 1 ? left_ : right_).sample(hit.surface, placeAt(hit.plane, place), footprint, paint))
        return sky;
    if (scene_.stains > 0)
        paint *= 1 + scene_.stains * stainsAt(hit, place, footprint);
    const double clear = std::exp(-metres / HAZE);
    return paint * clear + sky * (1 - clear);
}

double StreetRenderer::stainsAt(const Hit& hit, const cv::Vec3d& place, double footprint) const
{
    // Such that no side of a thing, upright or level, is seen along a line of equal stains; each side of the street has
    // its own.
    const cv::Vec3d v = placeAt(hit.plane == 3 ? 1 : hit.plane, place);
    return street::stains(v[0] + v[1] / 2, v[2] + v[1] + 100 * hit.plane, footprint);
}

cv::Mat StreetRenderer::render(bool moving, int samples, Rays rays) const
{
    CV_Assert(samples > 0);
    cv::Mat image(camera_.size, CV_32FC3);
    const bool byRow = camera_.scan < 2;
    const double shift = rays == STAGGERED ? 1. / samples : 0;
    const std::vector<Pose> poses = posesOfLines(moving);
    cv::parallel_for_(cv::Range(0, image.rows), [&](const cv::Range& range) {
        for (int y = range.start; y < range.end; y++)
            for (int x = 0; x < image.cols; x++)
            {
                const Pose& pose = poses[size_t(byRow ? y : x)];
                cv::Vec3f sum(0, 0, 0);
                for (int i = 0; i < samples; i++)
                    for (int j = 0; j < samples; j++)
                    {
                        const double u = j + 0.5 + shift * (i - (samples - 1) / 2.),
                                     v = i + 0.5 + shift * (j - (samples - 1) / 2.);
                        const cv::Point2d p(x + u / samples - 0.5, y + v / samples - 0.5);
                        sum += colour(pose.centre, turned(pose.c, pose.s, uprightRay(pose, p, moving)));
                    }
                image.at<cv::Vec3f>(y, x) = sum * (1.f / (samples * samples));
            }
    });
    if (scene_.noise > 0)
    {
        cv::Mat noise(image.size(), image.type());
        cv::RNG rng((scene_.seed + 104729u * scene_.frame) * 7919u + (moving ? 1 : 2));
        rng.fill(noise, cv::RNG::NORMAL, 0, scene_.noise);
        image += noise;
    }
    cv::Mat result;
    image.convertTo(result, CV_8U);
    return result;
}

cv::Mat StreetRenderer::depth(bool moving) const
{
    cv::Mat result(camera_.size, CV_32FC1);
    const bool byRow = camera_.scan < 2;
    const std::vector<Pose> poses = posesOfLines(moving);
    cv::parallel_for_(cv::Range(0, result.rows), [&](const cv::Range& range) {
        for (int y = range.start; y < range.end; y++)
            for (int x = 0; x < result.cols; x++)
            {
                const Pose& pose = poses[size_t(byRow ? y : x)];
                const cv::Vec3d ray = uprightRay(pose, cv::Point2d(x, y), moving); // 1 along the optical axis
                const cv::Vec3d direction = turned(pose.c, pose.s, ray);
                const Hit hit = cast(pose.centre, direction);
                const bool empty = !hit.plane || isSky(hit, pose.centre + direction * hit.distance);
                result.at<float>(y, x) = empty ? 0 : float(hit.distance);
            }
    });
    return result;
}

bool StreetRenderer::isSky(const Hit& hit, const cv::Vec3d& place) const
{
    cv::Vec3f paint;
    return hit.plane != 3 &&
           !(hit.plane == 1 ? left_ : right_).sample(hit.surface, placeAt(hit.plane, place), 0, paint);
}

cv::Mat StreetRenderer::rollingShutter(int samples, Rays rays) const
{
    return render(true, samples, rays);
}

cv::Mat StreetRenderer::globalShutter(int samples, Rays rays) const
{
    return render(false, samples, rays);
}

bool StreetRenderer::toGlobal(const cv::Point2d& rolling, cv::Point2d& global) const
{
    const Pose pose = poseAt(secondsAt(lineOf(rolling)));
    const cv::Vec3d ray = turned(pose.c, pose.s, uprightRay(pose, rolling, true));
    const Hit hit = cast(pose.centre, ray);
    // If no plane is met the scene is infinitely far away, and only the rotation counts.
    return project(poseAt(0), hit.plane ? pose.centre + ray * hit.distance : ray, false, global);
}

bool StreetRenderer::toRolling(const cv::Point2d& global, cv::Point2d& rolling) const
{
    const cv::Vec3d ray = uprightRay(poseAt(0), global, false);
    const Hit hit = cast(cv::Vec3d(0, 0, 0), ray);
    const cv::Vec3d place = hit.plane ? ray * hit.distance : ray;

    // The instant is found when the line at which the point is seen is the line being read.
    auto miss = [&](double line, double& value) {
        const Pose pose = poseAt(secondsAt(line));
        if (!project(pose, turned(pose.c, -pose.s, hit.plane ? place - pose.centre : place), true, rolling))
            return false;
        value = lineOf(rolling) - line;
        return true;
    };
    const double reach = 2. * std::max(camera_.size.width, camera_.size.height);
    double low = 0, high = 0, above = 0, below = 0;
    for (double step = 2;; step *= 2)
    {
        if (step > reach)
            return false;
        low = lineOf(global) - step;
        high = lineOf(global) + step;
        if (!miss(low, above) || !miss(high, below))
            return false;
        if (above >= 0 && below <= 0)
            break;
    }
    // False position; an end that stays counts half each time (Illinois).
    for (int last = 0; high - low > 1e-7 && above > below;)
    {
        const double line = low + (high - low) * above / (above - below);
        double value = 0;
        if (!miss(line, value))
            return false;
        if (std::abs(value) < 1e-8)
            break;
        const int end = value > 0 ? 1 : -1;
        (end > 0 ? low : high) = line;
        (end > 0 ? above : below) = value;
        if (end == last)
            (end > 0 ? below : above) /= 2;
        last = end;
    }
    return true;
}

void StreetRenderer::rectifyMap(cv::Mat& columns, cv::Mat& rows, cv::Mat& mask) const
{
    columns.create(camera_.size, CV_32FC1);
    rows.create(camera_.size, CV_32FC1);
    mask.create(camera_.size, CV_8UC1);
    cv::parallel_for_(cv::Range(0, camera_.size.height), [&](const cv::Range& range) {
        for (int y = range.start; y < range.end; y++)
            for (int x = 0; x < camera_.size.width; x++)
            {
                cv::Point2d p;
                if (!toRolling(cv::Point2d(x, y), p))
                    p = cv::Point2d(-1e4, -1e4);
                columns.at<float>(y, x) = float(p.x);
                rows.at<float>(y, x) = float(p.y);
                const bool inside =
                    p.x >= 0 && p.y >= 0 && p.x <= camera_.size.width - 1 && p.y <= camera_.size.height - 1;
                mask.at<uchar>(y, x) = inside ? 255 : 0;
            }
    });
}

} // namespace street
