// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_HPP
#define OPENCV_RSACKERMANN_HPP

#include "opencv2/rsackermann/camera.hpp"
#include "opencv2/rsackermann/motion.hpp"
#include "opencv2/rsackermann/solvers.hpp"
#include "opencv2/rsackermann/estimator.hpp"
#include "opencv2/rsackermann/depth_map.hpp"
#include "opencv2/rsackermann/warp.hpp"
#include "opencv2/rsackermann/draw.hpp"
#ifndef RSACKERMANN_CORE_ONLY
#include "opencv2/rsackermann/corrector.hpp"
#include "opencv2/rsackermann/calibration.hpp"
#endif

/** @defgroup rsackermann Rolling shutter compensation for cars from a single image

A car's camera reads its rows one after another while the car drives, so each image is skewed by the motion. From one
image and the direction of gravity this module estimates the yaw rate, the speed (up to the scale of the scene) and a
coarse depth (two walls and the road), and undoes the distortion with cv::remap. It implements @cite purkait2018minimal
and extends it.

The way from a raw image to a corrected one:
-   describe the camera with cv::rsackermann::RollingShutterCamera,
-   estimate the motion with cv::rsackermann::AckermannEstimator,
-   make the maps with cv::rsackermann::WarpMapGenerator and call cv::remap,

or let cv::rsackermann::RollingShutterCorrector do all of it in one call. cv::rsackermann::MountCalibrator
self-calibrates mounting angles and line delay from a drive.

Conventions of the whole module:
-   The camera frame has x to the right, y down and z forward. Pixel centres are at integer coordinates.
-   The *row time* of a pixel is \f$t = (row - referenceRow) / f_y\f$, dimensionless, always taken from the raw
    (distorted) sensor row; times \f$f_y \cdot lineDelay\f$ it is in seconds.
-   The *upright* frame has gravity along +y and the optical axis, projected to the horizontal, along +z. A bearing
    there is \f$(x, y, 1)\f$ or the azimuth \f$\varphi = \arctan x\f$.
-   The car turns by \f$\theta(t) = 2 \alpha t\f$ and moves by
    \f$\rho(t) (\sin(\theta/2+\psi), 0, \cos(\theta/2+\psi))\f$, \f$\rho(t) = \beta t\,\mathrm{sinc}(\theta/2)\f$,
    where \f$\psi\f$ is the heading.
-   Angles are in radians, lengths in metres, time in seconds, unless stated otherwise.

Threads: functions and const methods may run at the same time in several threads, also on the same object. Everything
else needs an object that no other thread uses meanwhile; different objects share no state. A
cv::rsackermann::AckermannEstimator or cv::rsackermann::WarpMapGenerator serves all threads, as their work on images is
const, but each thread needs its own cv::rsackermann::RollingShutterCorrector, which keeps buffers and the state of the
image before. cv::setNumThreads and cv::setRNGSeed don't change results.
*/

//! @namespace cv::rsackermann All of the module @ref rsackermann.

#endif // OPENCV_RSACKERMANN_HPP
