// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../checks.hpp"
#include "../storage.hpp"

namespace cv { namespace rsackermann {

RollingShutterCamera::RollingShutterCamera()
    : RollingShutterCamera(Size(), Matx33d::eye(), std::vector<double>(), LENS_PINHOLE)
{
    referenceRow = 0;
}

RollingShutterCamera::RollingShutterCamera(const Size& size, const Matx33d& K, const std::vector<double>& dist,
                                           int lens)
    : imageSize(size), cameraMatrix(K), distCoeffs(dist), lensModel(lens), scanDirection(SCAN_TOP_TO_BOTTOM),
      lineDelay(0), referenceRow((size.height - 1) / 2.), uprightRotation(Matx33d::eye()), rollSigma(2 * CV_PI / 180),
      pitchSigma(5 * CV_PI / 180), heading(0), headingSigma(5 * CV_PI / 180), height(0), focalSigma(0),
      distortionSigma(0), lineDelaySigma(0)
{
}

// A wrapped constructor can't throw: what is no list of numbers becomes one that check() refuses.
static std::vector<double> toCoefficients(const Mat& dist)
{
    const bool isList = dist.dims <= 2 && dist.channels() == 1 && (dist.rows <= 1 || dist.cols <= 1) &&
                        (dist.depth() == CV_32F || dist.depth() == CV_64F);
    if (dist.empty())
        return std::vector<double>();
    if (!isList)
        return std::vector<double>(dist.total() * size_t(dist.channels()), std::numeric_limits<double>::quiet_NaN());
    Mat values;
    dist.convertTo(values, CV_64F);
    return std::vector<double>(values.begin<double>(), values.end<double>());
}

RollingShutterCamera::RollingShutterCamera(const Size& size, const Matx33d& K, Mat& dist, int lens)
    : RollingShutterCamera(size, K, toCoefficients(dist), lens)
{
}

RollingShutterCamera RollingShutterCamera::fromFocal(const Size& size, double focal)
{
    REJECT_IF(!(focal >= 0) || cvIsInf(focal),
              "focal is %g; a positive number of pixels, or 0 for the default, is expected", focal);
    const double relative = 0.9, relativeSigma = 0.2, unknownDistortion = 0.15; // of cameras in cars
    const double f = focal > 0 ? focal : relative * std::max(size.width, size.height);
    RollingShutterCamera camera(size, Matx33d(f, 0, (size.width - 1) / 2., 0, f, (size.height - 1) / 2., 0, 0, 1));
    camera.focalSigma = focal > 0 ? 0 : relativeSigma * f;
    camera.distortionSigma = focal > 0 ? 0 : unknownDistortion;
    camera.check();
    return camera;
}

void RollingShutterCamera::setRollPitch(double roll, double pitch)
{
    REJECT_IF(!(std::abs(roll) < CV_PI / 2), "roll is %g rad; a value between -pi/2 and pi/2 is expected", roll);
    REJECT_IF(!(std::abs(pitch) < CV_PI / 2), "pitch is %g rad; a value between -pi/2 and pi/2 is expected", pitch);
    setGravity(Vec3d(std::sin(roll), std::cos(roll) * std::cos(pitch), std::sin(pitch)));
}

void RollingShutterCamera::setGravity(const Vec3d& gravity)
{
    const double length = norm(gravity);
    const double horizontal = std::hypot(gravity[0], gravity[1]);
    REJECT_IF(!(length > 0) || cvIsInf(length) || horizontal < 1e-6 * length,
              "gravity is (%g, %g, %g); a finite vector that isn't parallel to the optical axis is expected",
              gravity[0], gravity[1], gravity[2]);
    const Vec3d down = gravity * (1 / length);
    const Vec3d forward = normalize(Vec3d(0, 0, 1) - down * down[2]);
    const Vec3d right = down.cross(forward);
    uprightRotation =
        Matx33d(right[0], right[1], right[2], down[0], down[1], down[2], forward[0], forward[1], forward[2]);
    rollSigma = pitchSigma = 0;
}

Vec3d RollingShutterCamera::gravity() const
{
    return Vec3d(uprightRotation(1, 0), uprightRotation(1, 1), uprightRotation(1, 2));
}

double RollingShutterCamera::rowTime(const Point2d& pixel) const
{
    const double line = isRowShutter() ? pixel.y : pixel.x;
    const bool backward = scanDirection == SCAN_BOTTOM_TO_TOP || scanDirection == SCAN_RIGHT_TO_LEFT;
    const double time = (line - referenceRow) / cameraMatrix(1, 1);
    return backward ? -time : time;
}

double RollingShutterCamera::secondsPerUnitTime() const
{
    return cameraMatrix(1, 1) * lineDelay;
}

bool RollingShutterCamera::isRowShutter() const
{
    return scanDirection == SCAN_TOP_TO_BOTTOM || scanDirection == SCAN_BOTTOM_TO_TOP;
}

static void checkIntrinsics(const Matx33d& K)
{
    const double largest = 1e9; // whose powers, and quotients with what is in an image, are finite
    for (int i = 0; i < 9; i++)
        REJECT_IF(!(std::abs(K.val[i]) <= largest),
                  "camera.cameraMatrix has the entry %g; pixels up to %g are expected", K.val[i], largest);
    REJECT_IF(!(K(0, 0) >= 1 / largest) || !(K(1, 1) >= 1 / largest),
              "camera.cameraMatrix has focal lengths %g, %g; positive ones are expected", K(0, 0), K(1, 1));
    REJECT_IF(K(0, 1) != 0 || K(1, 0) != 0 || K(2, 0) != 0 || K(2, 1) != 0 || K(2, 2) != 1,
              "camera.cameraMatrix has other entries than fx, fy, cx, cy and 1; a matrix (fx 0 cx; 0 fy cy; 0 0 1) is "
              "expected");
}

static void checkLens(int lensModel, const std::vector<double>& coefficients)
{
    const size_t n = coefficients.size();
    REJECT_IF(lensModel != LENS_PINHOLE && lensModel != LENS_FISHEYE,
              "camera.lensModel is %d; LENS_PINHOLE (0) or LENS_FISHEYE (1) is expected", lensModel);
    REJECT_IF(lensModel == LENS_FISHEYE && n != 0 && n != 4,
              "camera.distCoeffs has %d values; 0 or 4 are expected for LENS_FISHEYE", (int)n);
    REJECT_IF(lensModel == LENS_PINHOLE && n != 0 && n != 4 && n != 5 && n != 8 && n != 12 && n != 14,
              "camera.distCoeffs has %d values; 0, 4, 5, 8, 12 or 14 are expected for LENS_PINHOLE", (int)n);
    for (size_t i = 0; i < n; i++)
        checkFinite(coefficients[i], "camera.distCoeffs");
}

static void checkRotation(const Matx33d& R)
{
    for (int i = 0; i < 9; i++)
        checkFinite(R.val[i], "camera.uprightRotation");
    const double error = norm(R * R.t() - Matx33d::eye(), NORM_INF);
    REJECT_IF(error > 1e-6 || determinant(R) < 0,
              "camera.uprightRotation is off a rotation by %g; a rotation matrix is expected", error);
    const double most = 0.05; // three degrees, which matter to nobody's heading
    REJECT_IF(std::abs(R(0, 2)) > most || R(2, 2) < -most,
              "camera.uprightRotation turns the optical axis to (%g, %g, %g); x between -%g and %g, and z ahead, are "
              "expected: setGravity() makes one without yaw, which is the camera's heading",
              R(0, 2), R(1, 2), R(2, 2), most, most);
}

void RollingShutterCamera::check() const
{
    const int most = 65535; // what is kept for each row or column has to fit into memory
    REJECT_IF(imageSize.width <= 0 || imageSize.height <= 0 || imageSize.width > most || imageSize.height > most,
              "camera.imageSize is %d x %d; a width and height of 1 to %d are expected", imageSize.width,
              imageSize.height, most);
    checkIntrinsics(cameraMatrix);
    checkLens(lensModel, distCoeffs);
    REJECT_IF(scanDirection < SCAN_TOP_TO_BOTTOM || scanDirection > SCAN_RIGHT_TO_LEFT,
              "camera.scanDirection is %d; one of the ScanDirection values 0 to 3 is expected", scanDirection);
    checkNotNegative(lineDelay, "camera.lineDelay", "unknown");
    const int lines = isRowShutter() ? imageSize.height : imageSize.width;
    REJECT_IF(lineDelay > LONGEST_READ_OUT / lines,
              "camera.lineDelay is %g s, %g s for %d lines; up to %g s for all of them is expected", lineDelay,
              lineDelay * lines, lines, LONGEST_READ_OUT);
    checkFinite(referenceRow, "camera.referenceRow");
    checkRotation(uprightRotation);
    checkNotNegative(rollSigma, "camera.rollSigma", "exact");
    checkNotNegative(pitchSigma, "camera.pitchSigma", "exact");
    checkAngle(heading, "camera.heading");
    checkNotNegative(headingSigma, "camera.headingSigma", "exact");
    checkNotNegative(height, "camera.height", "unknown");
    checkNotNegative(focalSigma, "camera.focalSigma", "exact");
    checkNotNegative(distortionSigma, "camera.distortionSigma", "exact");
    checkNotNegative(lineDelaySigma, "camera.lineDelaySigma", "exact");
}

void RollingShutterCamera::write(FileStorage& fs) const
{
    fs << "image_width" << imageSize.width << "image_height" << imageSize.height;
    fs << "camera_matrix" << cameraMatrix;
    fs << "distortion_coefficients" << distCoeffs;
    fs << "lens_model" << lensModel << "scan_direction" << scanDirection;
    fs << "line_delay" << lineDelay << "reference_row" << referenceRow;
    fs << "upright_rotation" << uprightRotation << "roll_sigma" << rollSigma << "pitch_sigma" << pitchSigma;
    fs << "heading" << heading << "heading_sigma" << headingSigma << "height" << height;
    fs << "focal_sigma" << focalSigma << "distortion_sigma" << distortionSigma << "line_delay_sigma" << lineDelaySigma;
}

// A list, or one row or column as files of other calibrations have it.
static void readCoefficients(const FileNode& node, std::vector<double>& coefficients)
{
    if (!node.isMap())
    {
        node >> coefficients;
        return;
    }
    const int most = 14;
    const Size stored = storedSize(node);
    REJECT_IF(std::min(stored.width, stored.height) != 1 || std::max(stored.width, stored.height) > most,
              "%s is %d x %d; a row or column of up to %d is expected", node.name().c_str(), stored.height,
              stored.width, most);
    Mat matrix;
    node >> matrix;
    Mat_<double>(matrix.reshape(1, 1)).copyTo(coefficients);
}

void RollingShutterCamera::read(const FileNode& fn)
{
    readFields(fn, "image_width", imageSize.width, "image_height", imageSize.height);
    readMatrix(fn, "camera_matrix", cameraMatrix);
    if (!fn["distortion_coefficients"].empty())
        readCoefficients(fn["distortion_coefficients"], distCoeffs);
    readFields(fn, "lens_model", lensModel, "scan_direction", scanDirection, "line_delay", lineDelay);
    readFields(fn, "reference_row", referenceRow);
    readMatrix(fn, "upright_rotation", uprightRotation);
    if (!fn["upright_rotation"].empty())
        rollSigma = pitchSigma = 0;
    readFields(fn, "roll_sigma", rollSigma, "pitch_sigma", pitchSigma);
    if (!fn["heading"].empty())
        headingSigma = 0;
    readFields(fn, "heading", heading, "heading_sigma", headingSigma, "height", height, "focal_sigma", focalSigma);
    readFields(fn, "distortion_sigma", distortionSigma, "line_delay_sigma", lineDelaySigma);
}

}} // namespace cv::rsackermann
