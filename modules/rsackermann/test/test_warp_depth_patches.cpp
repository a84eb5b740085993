// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_simulator.hpp"
#include "../src/warp/depth/visibility.hpp"
#include "../src/warp/maps/maps.hpp"

// Maps by depth are made by patches, and pixel by pixel where no patch fits: it is the same, and so is what is hidden.

namespace opencv_test { namespace {

using namespace cv::rsackermann;

//! Places to which no patch fits.
class RoughPlaces CV_FINAL : public DepthPlaces
{
public:
    explicit RoughPlaces(const DepthPlaces& places_) : DepthPlaces(places_), places(places_) {}

    bool find(const Point2d& pixel, double inverseDepth, Point2d& place, Guess& guess) const CV_OVERRIDE
    {
        return places.find(pixel, inverseDepth, place, guess);
    }
    bool hasKnots() const CV_OVERRIDE { return true; }
    bool isSmoothBetween(const Point2d&, const Point2d&, const Point2d&, const Point2d&) const CV_OVERRIDE
    {
        return false;
    }

private:
    double rowTime(const Point2d&, const Point2d&) const CV_OVERRIDE { return 0; }

    const DepthPlaces& places;
};

//! Boxes before a wall: what is beside the middle hides to the left or to the right, what is below it upwards or
//! downwards.
Mat1f boxesBeforeWall(const Size& size)
{
    Mat1f depths(size, 9.f);
    for (int i = 0; i < 6; i++)
        depths(Rect(20 + 50 * i, 20 + 30 * i, 20, 60)).setTo(3 + 0.4 * i);
    depths(Rect(100, 170, 110, 40)).setTo(2.5);
    return depths;
}

//! A surface that comes nearer and recedes within a patch.
Mat1f waves(const Size& size)
{
    Mat1f depths(size);
    for (int y = 0; y < size.height; y++)
        for (int x = 0; x < size.width; x++)
            depths(y, x) = float(6 + 1.5 * std::sin(x / 15.) * std::cos(y / 20.));
    return depths;
}

// Newton's steps have to reach what each pixel's own search does, from whatever depth they start.
TEST(RSAckermann_WarpDepthPatches, of_waves)
{
    RollingShutterCamera camera(Size(320, 240), Matx33d(300, 0, 155, 0, 310, 115, 0, 0, 1));
    camera.lineDelay = 0.03 / 240;
    const DepthMap depth(waves(camera.imageSize), DEPTH_RAW);
    const AckermannMotion motion = motionFromMetric(camera, 0.5, 25, 4, 5, 0.02);
    const double way = 25 * camera.secondsPerUnitTime();
    const ShutterGeometry shutter(camera, motion);
    const RectifyPlaces places(shutter, camera.cameraMatrix, way, true, 20, 1e-6);
    const RoughPlaces rough(places);
    const InverseDepthImage depths(depth, shutter, camera.cameraMatrix, way, 1);
    Mat map1[2], map2[2], distance;
    for (int k = 0; k < 2; k++)
    {
        MapWriter writer(camera.imageSize, camera.imageSize, CV_32FC1, map1[k], map2[k], noArray());
        fillByOtherDepth(k == 0 ? static_cast<const DepthPlaces&>(places) : rough, depths, writer);
    }
    for (const Mat* maps : {map1, map2})
    {
        cv::absdiff(maps[0], maps[1], distance);
        EXPECT_EQ(0, countNonZero(distance > 5e-4));
    }
}

// Depths of either camera, maps of either direction, cars that go either way.
TEST(RSAckermann_WarpDepthPatches, are_as_good_as_pixels)
{
    RollingShutterCamera camera(Size(320, 240), Matx33d(300, 0, 155, 0, 310, 115, 0, 0, 1), {-0.2, 0.05, 1e-3, -1e-3});
    camera.lineDelay = 0.03 / 240;
    const double nearest = 1;
    const Mat1f values = boxesBeforeWall(camera.imageSize);
    for (const double speed : {16., -16.})
        for (const int ofCamera : {DEPTH_RAW, DEPTH_CORRECTED})
            for (const bool isRectify : {true, false})
            {
                SCOPED_TRACE(testing::Message() << speed << " " << ofCamera << " " << isRectify);
                const AckermannMotion motion = motionFromMetric(camera, 0.5, speed, 4, 5, 0.02);
                const double way = speed * camera.secondsPerUnitTime();
                const bool ofRaw = ofCamera == DEPTH_RAW;
                const ShutterGeometry shutter(camera, motion);
                const RectifyPlaces rectify(shutter, camera.cameraMatrix, way, ofRaw, 20, 1e-6);
                const DistortPlaces distort(shutter, camera.cameraMatrix, way, ofRaw);
                const RoughPlaces roughRectify(rectify), roughDistort(distort);
                const DepthPlaces* const places[2][2] = {{&rectify, &distort}, {&roughRectify, &roughDistort}};
                const DepthMap depth(values, ofCamera);
                const InverseDepthImage depths(depth, shutter, camera.cameraMatrix, way, nearest);
                Mat map1[2], map2[2], mask[2], distance;
                for (int k = 0; k < 2; k++)
                {
                    const DepthPlaces &there = *places[k][!isRectify], &back = *places[k][isRectify];
                    MapWriter writer(camera.imageSize, camera.imageSize, CV_32FC1, map1[k], map2[k], mask[k]);
                    const Visibility visibility(back, depths, camera.imageSize);
                    if (ofRaw == isRectify)
                        fillByOtherDepth(there, depths, writer);
                    else
                        fillByOwnDepth(there, depths, &visibility, writer);
                }
                EXPECT_GT(countNonZero(mask[0] == MASK_HIDDEN), 200);
                // At borders of what is hidden rounding decides.
                EXPECT_LE(countNonZero(mask[0] != mask[1]), 20);
                cv::absdiff(map1[0], map1[1], distance);
                EXPECT_LE(countNonZero(distance > 2e-3), 20);
            }
}

}} // namespace opencv_test::
