// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "frame_terms.hpp"
#include "seen_camera.hpp"

namespace cv { namespace rsackermann {

// In standard deviations of slants: edges that lean as a read-out would make them.
static const double LEAN_SIGMA = 0.2;
// Of the ratio, by verticals that are nearer or farther than planes.
static const double DISTANCE_SIGMA = 0.1;
// Radians, of a heading that is given as exact.
static const double EXACT_HEADING = 1e-9;

CameraEvidence measureCamera(const RollingShutterCamera& camera, const std::vector<UprightSegment>& verticals,
                             const std::vector<double>& weights, const CameraEquations& others, double about,
                             double curvature, SequenceState& state)
{
    enum {
        BY_READOUT = PARAMETERS + CAMERA_READOUT,
        BY_HEADING = PARAMETERS + CAMERA_HEADING,
        BY_LEVER = PARAMETERS + CAMERA_LEVER
    };
    typedef Eigen::Matrix<double, PARAMETERS + CAMERA_VALUES, 1> Gradient;
    typedef Eigen::Matrix<double, FLOW_VALUES, FLOW_VALUES> StateInformation;
    typedef Eigen::Matrix<double, FLOW_VALUES + CAMERA_VALUES, CAMERA_VALUES> Ways;
    struct Slant
    {
        double value; // in sigmas
        Gradient by;
    };
    const double focal = camera.cameraMatrix(0, 0);
    const CauchyLoss loss(SLANT_SCALE, 1 / DEPENDENCE);
    Matx<double, PARAMETERS, SEQUENCE_VALUES> byValues;
    const Model values = toModel(state.value, camera.secondsPerUnitTime(), &byValues);
    const PreparedModel model(values, camera.heading), turned(values, camera.heading + HEADING_STEP);
    std::vector<Slant> slants(verticals.size());
    for (size_t i = 0; i < verticals.size(); i++)
    {
        Slant& s = slants[i];
        s.value = slantInSigmas(verticals[i], model, focal, s.by.data());
        s.by[BY_READOUT] = 0;
        for (const Parameter rate : {P_ALPHA, P_B, P_D})
            s.by[BY_READOUT] += s.by[rate] * values[rate];
        s.by[BY_HEADING] = (slantInSigmas(verticals[i], turned, focal, 0) - s.value) / HEADING_STEP;
        s.by[BY_LEVER] = curvature * s.by[BY_HEADING];
    }
    Eigen::Matrix<double, PARAMETERS + CAMERA_VALUES, FLOW_VALUES + CAMERA_VALUES> J;
    J.setZero();
    J.topLeftCorner<PARAMETERS, SEQUENCE_VALUES>() =
        Eigen::Map<const Eigen::Matrix<double, SEQUENCE_VALUES, PARAMETERS>>(byValues.val).transpose();
    J.bottomRightCorner<CAMERA_VALUES, CAMERA_VALUES>().setIdentity();
    // By how much the state gives way to another camera depends on the weights, and they on it.
    Ways ways = Ways::Zero();
    ways.topRows<SEQUENCE_VALUES>() = Eigen::Map<const StateByCamera>(state.byCamera.val);
    ways.bottomRows<CAMERA_VALUES>().setIdentity();
    CameraEvidence evidence;
    for (int i = 0; i < 3; i++)
    {
        const Gradient byReadout = J * ways.col(CAMERA_READOUT);
        NormalEquations<PARAMETERS + CAMERA_VALUES> sums;
        evidence = CameraEvidence();
        for (size_t k = 0; k < slants.size(); k++)
        {
            const Slant& s = slants[k];
            const double slant = s.value + (about - 1) * s.by.dot(byReadout),
                         weight = weights[k] * loss.slope(slant * slant);
            sums.information += weight * s.by * s.by.transpose();
            sums.gradient += weight * s.value * s.by;
            evidence.weight += weight;
        }
        const CameraEquations::Matrix information = others.symmetric() + J.transpose() * sums.information * J;
        const CameraEquations::Vector gradient = others.gradient + J.transpose() * sums.gradient;
        const StateInformation ofState = information.topLeftCorner<FLOW_VALUES, FLOW_VALUES>();
        ways.topRows<FLOW_VALUES>() =
            -scaledInverse(ofState) * information.topRightCorner<FLOW_VALUES, CAMERA_VALUES>();
        Eigen::Map<Eigen::Matrix<double, CAMERA_VALUES, CAMERA_VALUES>>(evidence.information.val) =
            information.bottomRows<CAMERA_VALUES>() * ways;
        Eigen::Map<Eigen::Matrix<double, CAMERA_VALUES, 1>>(evidence.gradient.val) = ways.transpose() * gradient;
    }
    Eigen::Map<StateByCamera>(state.byCamera.val) = ways.topRows<SEQUENCE_VALUES>();
    return evidence;
}

void SeenCamera::add(CameraEvidence frame, const CameraVector& difference, double longestNow)
{
    frame.gradient -= frame.information * difference;
    longest += longestNow;
    frames++;
    if (count == 0 || framesOfLast == framesOfPart)
    {
        if (count == MOST_PARTS)
        {
            for (int i = 0; i < MOST_PARTS / 2; i++)
            {
                const CameraEvidence later = parts[2 * i + 1];
                parts[i] = parts[2 * i];
                parts[i].add(later);
            }
            count /= 2;
            framesOfPart *= 2;
        }
        parts[count++] = CameraEvidence();
        framesOfLast = 0;
    }
    parts[count - 1].add(frame);
    framesOfLast++;
    sum.add(frame);
}

static double informationOf(double headingSigma)
{
    return 1 / std::pow(std::max(headingSigma, EXACT_HEADING), 2);
}

// Of the information on the values. @param ofHeading that of the given one.
CameraMatrix SeenCamera::inverse(double ofHeading) const
{
    typedef Eigen::Matrix<double, CAMERA_VALUES, CAMERA_VALUES> Square;
    CameraMatrix result = sum.information;
    result(CAMERA_LEVER, CAMERA_LEVER) += 1 / (LEVER_SIGMA * LEVER_SIGMA);
    result(CAMERA_HEADING, CAMERA_HEADING) += ofHeading;
    Eigen::Map<Square> square(result.val);
    square = scaledInverse<Square>(square);
    return result;
}

// By how parts differ from the values that are found with an inverse.
CameraMatrix SeenCamera::scatter(const CameraMatrix& inverse) const
{
    if (count < MOST_PARTS / 2)
        return CameraMatrix::zeros();
    const CameraVector found = shown(inverse);
    CameraMatrix squares = CameraMatrix::zeros();
    for (int i = 0; i < count; i++)
    {
        const CameraVector gradient = parts[i].gradient + parts[i].information * found;
        squares += gradient * gradient.t();
    }
    // By the variance of Student's distribution, (n - 1) / (n - 3).
    return inverse * squares * inverse * (double(count) / (count - 3));
}

bool SeenCamera::isPossible() const
{
    return frames == 0 || std::abs(shownRatio()) < longest / frames + CONTRADICTION * uncheckedRatioSigma();
}

double SeenCamera::readoutRatio() const
{
    if (frames == 0 || !isPossible())
        return 1;
    const double most = longest / frames;
    return std::min(std::max(shownRatio(), -most), most);
}

double SeenCamera::readoutRatioSigma() const
{
    return isPossible() ? uncheckedRatioSigma() : 0;
}

double SeenCamera::uncheckedRatioSigma() const
{
    const CameraMatrix ofAll = inverse();
    const double byParts = scatter(ofAll)(CAMERA_READOUT, CAMERA_READOUT),
                 byLeans = LEAN_SIGMA * LEAN_SIGMA * sum.weight * ofAll(CAMERA_READOUT, CAMERA_READOUT);
    return byParts > 0 ? std::sqrt(byParts + byLeans + DISTANCE_SIGMA * DISTANCE_SIGMA) : 0;
}

// The most probable ratio of those that are possible has to be as much more so than the given one.
double SeenCamera::readoutContradiction() const
{
    const double shown = shownRatio(), ratio = readoutRatio(), sigma = readoutRatioSigma(),
                 gain = std::pow(shown - 1, 2) - std::pow(shown - ratio, 2);
    return sigma > 0 && gain > std::pow(CONTRADICTION * sigma, 2) ? ratio : 1;
}

double SeenCamera::heading() const
{
    return headingSigma() > 0 ? shown(inverse())[CAMERA_HEADING] : 0;
}

double SeenCamera::headingSigma() const
{
    const CameraMatrix ofAll = inverse();
    const double sigma = std::sqrt((ofAll + scatter(ofAll))(CAMERA_HEADING, CAMERA_HEADING));
    return sigma < CV_PI ? sigma : 0;
}

CameraVector SeenCamera::difference(double headingSigma) const
{
    CameraVector result = shown(inverse(informationOf(headingSigma)));
    result[CAMERA_READOUT] = 0;
    return result;
}

CameraMatrix SeenCamera::covariance(double headingSigma) const
{
    const CameraMatrix ofAll = inverse(informationOf(headingSigma));
    CameraMatrix result = ofAll + scatter(ofAll);
    for (int i = 0; i < CAMERA_VALUES; i++)
        result(i, CAMERA_READOUT) = result(CAMERA_READOUT, i) = 0;
    return result;
}

}} // namespace cv::rsackermann
