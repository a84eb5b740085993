// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "frame_terms.hpp"
#include "readout_ratio.hpp"

namespace cv { namespace rsackermann {

// In standard deviations of slants: edges that lean as a read-out would make them.
static const double LEAN_SIGMA = 0.2;
// Of the ratio, by verticals that are nearer or farther than planes.
static const double DISTANCE_SIGMA = 0.1;

ReadoutEvidence measureReadout(const RollingShutterCamera& camera, const std::vector<UprightSegment>& verticals,
                               const std::vector<double>& weights, const ReadoutEquations& others, double about,
                               SequenceState& state)
{
    enum { BY_READOUT = PARAMETERS + CAMERA_READOUT, BY_HEADING = PARAMETERS + CAMERA_HEADING };
    typedef Eigen::Matrix<double, PARAMETERS + CAMERA_VALUES, 1> Gradient;
    typedef Eigen::Matrix<double, FLOW_VALUES, FLOW_VALUES> StateInformation;
    typedef Eigen::Matrix<double, FLOW_VALUES + CAMERA_VALUES, CAMERA_VALUES> Ways;
    typedef Eigen::Matrix<double, SEQUENCE_VALUES, CAMERA_VALUES, Eigen::RowMajor> StateByCamera;
    struct Slant
    {
        double value; // in sigmas
        Gradient by;
    };
    const double step = std::sqrt(DBL_EPSILON), focal = camera.cameraMatrix(0, 0);
    const CauchyLoss loss(SLANT_SCALE, 1 / DEPENDENCE);
    Matx<double, PARAMETERS, SEQUENCE_VALUES> byValues;
    const Model values = toModel(state.value, camera.secondsPerUnitTime(), &byValues);
    const PreparedModel model(values, camera.heading), turned(values, camera.heading + step);
    std::vector<Slant> slants(verticals.size());
    for (size_t i = 0; i < verticals.size(); i++)
    {
        Slant& s = slants[i];
        s.value = slantInSigmas(verticals[i], model, focal, s.by.data());
        s.by[BY_READOUT] = 0;
        for (const Parameter rate : {P_ALPHA, P_B, P_D})
            s.by[BY_READOUT] += s.by[rate] * values[rate];
        s.by[BY_HEADING] = (slantInSigmas(verticals[i], turned, focal, 0) - s.value) / step;
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
    ReadoutEvidence evidence;
    for (int i = 0; i < 3; i++)
    {
        const Gradient byReadout = J * ways.col(CAMERA_READOUT);
        NormalEquations<PARAMETERS + CAMERA_VALUES> sums;
        evidence = ReadoutEvidence();
        for (size_t k = 0; k < slants.size(); k++)
        {
            const Slant& s = slants[k];
            const double slant = s.value + (about - 1) * s.by.dot(byReadout),
                         weight = weights[k] * loss.slope(slant * slant);
            sums.information += weight * s.by * s.by.transpose();
            sums.gradient += weight * s.value * s.by;
            evidence.weight += weight;
        }
        const ReadoutEquations::Matrix information = others.symmetric() + J.transpose() * sums.information * J;
        const ReadoutEquations::Vector gradient = others.gradient + J.transpose() * sums.gradient;
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

void ReadoutRatio::add(const ReadoutEvidence& frame, double longestNow)
{
    longest += longestNow;
    frames++;
    if (count == 0 || framesOfLast == framesOfPart)
    {
        if (count == MOST_PARTS)
        {
            for (int i = 0; i < MOST_PARTS / 2; i++)
            {
                const ReadoutEvidence later = parts[2 * i + 1];
                parts[i] = parts[2 * i];
                parts[i].add(later);
            }
            count /= 2;
            framesOfPart *= 2;
        }
        parts[count++] = ReadoutEvidence();
        framesOfLast = 0;
    }
    parts[count - 1].add(frame);
    framesOfLast++;
    sum.add(frame);
}

ReadoutRatio::Solution ReadoutRatio::solution() const
{
    const Matx22d& A = sum.information;
    Solution s;
    s.headingShare = A(1, 1) > 0 ? A(0, 1) / A(1, 1) : 0;
    s.information = A(0, 0) - s.headingShare * A(0, 1);
    if (s.information > 0)
        s.change[0] = -(sum.gradient[0] - s.headingShare * sum.gradient[1]) / s.information;
    if (A(1, 1) > 0)
        s.change[1] = -(sum.gradient[1] + A(0, 1) * s.change[0]) / A(1, 1);
    return s;
}

double ReadoutRatio::scatter() const
{
    const Solution s = solution();
    if (count < MOST_PARTS / 2 || !(s.information > 0))
        return 0;
    double squares = 0;
    for (int i = 0; i < count; i++)
    {
        const Vec2d gradient = parts[i].gradient + parts[i].information * s.change;
        squares += std::pow(gradient[0] - s.headingShare * gradient[1], 2);
    }
    // By the variance of Student's distribution, (n - 1) / (n - 3).
    const double byParts = std::sqrt(squares * count / (count - 3)) / s.information,
                 byLeans = LEAN_SIGMA * std::sqrt(sum.weight / s.information);
    return std::sqrt(byParts * byParts + byLeans * byLeans + DISTANCE_SIGMA * DISTANCE_SIGMA);
}

bool ReadoutRatio::isPossible() const
{
    return frames == 0 || std::abs(shown()) < longest / frames + CONTRADICTION * scatter();
}

double ReadoutRatio::value() const
{
    return isPossible() ? shown() : 1;
}

double ReadoutRatio::sigma() const
{
    return isPossible() ? scatter() : 0;
}

double ReadoutRatio::contradiction() const
{
    return sigma() > 0 && std::abs(value() - 1) > CONTRADICTION * sigma() ? value() : 1;
}

}} // namespace cv::rsackermann
