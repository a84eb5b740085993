// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_STREET_RENDERER_HPP
#define RSACKERMANN_SAMPLES_STREET_RENDERER_HPP

#include "shake.hpp"
#include "street_side.hpp"

namespace street {

//! A camera with a rolling shutter; the conventions are those of cv::rsackermann::RollingShutterCamera.
struct StreetCamera
{
    cv::Size size;
    double fx, fy, cx, cy;
    std::vector<double> lens; //!< 0, 4, 5 or 8 coefficients of the model of cv::projectPoints
    double lineDelay;         //!< seconds between two lines
    int scan;                 //!< 0 down, 1 up, 2 to the right, 3 to the left
    double reference;         //!< line at whose instant the global-shutter image is taken
    double roll, pitch;       //!< radians
    double heading;           //!< radians from the optical axis to the direction of driving
    double height;            //!< metres above the road
    Shake shake;              //!< of the camera against the mount that roll and pitch are those of
    double seconds;           //!< time of the reference line on the clock of the shake

    //! A camera at a given height that looks ahead, with its principal point and reference at the image's centre.
    StreetCamera(const cv::Size& size, double focal, double lineDelay, double height);
};

//! Where the car drives and how.
struct StreetScene
{
    double yawRate;       //!< radians per second, positive to the right
    double speed;         //!< metres per second, negative in reverse
    double left, right;   //!< metres to the walls, 0: there is none
    double edges[2];      //!< metres to the left and right edge of the road where there is no wall
    double wallDirection; //!< radians from the optical axis to the direction along the walls
    //! Metres along the walls from where the street begins: frames of a drive have the same street
    double travelled;
    double sideways;  //!< metres to the right, across the walls, from the line along which a drive began
    unsigned seed;    //!< of the facades and the noise
    double clutter;   //!< share of slanted lines, 0..1
    double stagger;   //!< metres: each house stands back from its wall by its own amount between 0 and this
    double obstacles; //!< cars, posts and trees on 100 m of each side
    double stains;    //!< contrast of stains on everything, 0..1
    double noise;     //!< standard deviation of the image noise in grey levels
    unsigned frame;   //!< of a drive: each has noise of its own

    StreetScene();
};

//! Radians per second at which a camera turns about its axes (x to the right, y down, z ahead) at the reference line's
//! instant. @param yawRate of the car, radians per second.
cv::Vec3d turnRates(const StreetCamera& camera, double yawRate);

//! Turns places of the street into the frame of the camera (x to the right, y down, z ahead) at the reference line's
//! instant. Those of the street are metres to the right, downwards and along the walls from the camera at the
//! beginning.
cv::Matx44d viewMatrix(const StreetCamera& camera, const StreetScene& scene);

/** Renders a street and knows the true correspondence of rolling and global shutter.

Every line of the image is cast with the pose that the camera has at that line's instant: yaw 2 alpha t about the
vertical, position on the chord of the circle that the car drives, and as the camera shakes. Nothing here is shared with
the library, which is measured by it.
*/
class StreetRenderer
{
public:
    //! Where the rays of a pixel are.
    enum Rays {
        ON_GRID,
        //! Rows and columns of the grid are shifted so that each ray has an x and a y of its own: what leans by less
        //! than a pixel over its length is drawn as with samples^2 x samples^2 rays.
        STAGGERED
    };

    StreetRenderer(const StreetCamera& camera, const StreetScene& scene);

    //! The view of the rolling-shutter camera, through its lens; each pixel is the mean of samples x samples rays.
    cv::Mat rollingShutter(int samples = 3, Rays rays = ON_GRID) const;
    //! The view of a global-shutter camera without lens distortion at the reference line's instant.
    cv::Mat globalShutter(int samples = 3, Rays rays = ON_GRID) const;

    //! Metres along the optical axis to what the centre of each pixel of the rolling-shutter image shows, at its line's
    //! instant (CV_32FC1); 0 for the sky.
    cv::Mat rollingDepth() const { return depth(true); }
    //! The same of the global-shutter image.
    cv::Mat globalDepth() const { return depth(false); }

    //! Place in the rolling-shutter image of a point of the global-shutter image; false if there is none.
    bool toRolling(const cv::Point2d& global, cv::Point2d& rolling) const;
    //! Place in the global-shutter image of a point of the rolling-shutter image; false if there is none.
    bool toGlobal(const cv::Point2d& rolling, cv::Point2d& global) const;

    //! toRolling() of every pixel (CV_32FC1 each) and, as mask, whether the place lies in the rolling-shutter image.
    void rectifyMap(cv::Mat& columns, cv::Mat& rows, cv::Mat& mask) const;

private:
    struct Pose
    {
        cv::Matx33d upright; // turns the camera frame into the upright one of the mount
        double c, s;         // of the yaw
        cv::Vec3d centre;    // metres
    };

    struct Hit
    {
        int plane;                   // 0 none, 1 left wall, 2 right wall, 3 road
        double distance;             // in lengths of the ray
        StreetSide::Surface surface; // if the plane is that of a wall
    };

    cv::Mat render(bool moving, int samples, Rays rays) const;
    cv::Mat depth(bool moving) const;
    cv::Vec3f colour(const cv::Vec3d& origin, const cv::Vec3d& ray) const;
    double stainsAt(const Hit& hit, const cv::Vec3d& place, double footprint) const;
    bool isSky(const Hit& hit, const cv::Vec3d& place) const;
    Pose poseAt(double seconds) const;
    double secondsAt(double line) const;
    double lineOf(const cv::Point2d& p) const { return camera_.scan < 2 ? p.y : p.x; }
    std::vector<Pose> posesOfLines(bool moving) const;
    cv::Vec3d uprightRay(const Pose& pose, const cv::Point2d& pixel, bool throughLens) const;
    bool project(const Pose& pose, const cv::Vec3d& upright, bool throughLens, cv::Point2d& pixel) const;
    Hit cast(const cv::Vec3d& origin, const cv::Vec3d& ray) const;
    void castUneven(const cv::Vec3d& origin, const cv::Vec3d& ray, Hit& hit) const;
    // In the terms of the side of the street of a plane.
    cv::Vec3d directionAt(int plane, const cv::Vec3d& v) const;
    cv::Vec3d placeAt(int plane, const cv::Vec3d& v) const;
    double leftEdge() const; // of the road, metres

    StreetCamera camera_;
    StreetScene scene_;
    cv::Matx33d mount_; // turns the frame of the mount upright
    cv::Vec3d along_, across_;
    StreetSide left_, right_;
};

} // namespace street

#endif // RSACKERMANN_SAMPLES_STREET_RENDERER_HPP
