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
                               const std::vector<double>& weights, const SequenceVector& state,
                               const ReadoutEquations& others, double about, SequenceVector& byReadout)
{
    enum { RATIO = FLOW_VALUES };
    typedef Eigen::Matrix<double, PARAMETERS + 1, 1> Gradient; // by the model, and by the ratio
    struct Slant
    {
        double value; // in sigmas
        Gradient by;
    };
    const CauchyLoss loss(SLANT_SCALE, 1 / DEPENDENCE);
    Matx<double, PARAMETERS, SEQUENCE_VALUES> byValues;
    const Model values = toModel(state, camera.secondsPerUnitTime(), &byValues);
    const PreparedModel model(values, camera.heading);
    std::vector<Slant> slants(verticals.size());
    for (size_t i = 0; i < verticals.size(); i++)
    {
        Slant& s = slants[i];
        s.value = slantInSigmas(verticals[i], model, camera.cameraMatrix(0, 0), s.by.data());
        s.by[PARAMETERS] = 0;
        for (const Parameter rate : {P_ALPHA, P_B, P_D})
            s.by[PARAMETERS] += s.by[rate] * values[rate];
    }
    ReadoutEquations::Matrix toModelAndRatio = ReadoutEquations::Matrix::Zero(); // the first rows
    toModelAndRatio.topLeftCorner<PARAMETERS, SEQUENCE_VALUES>() =
        Eigen::Map<const Eigen::Matrix<double, SEQUENCE_VALUES, PARAMETERS>>(byValues.val).transpose();
    toModelAndRatio(PARAMETERS, RATIO) = 1;
    const auto J = toModelAndRatio.topRows<PARAMETERS + 1>();
    // By how much the state gives way to another ratio depends on the weights, and they on it.
    ReadoutEquations::Vector way = ReadoutEquations::Vector::Zero();
    std::copy(byReadout.val, byReadout.val + SEQUENCE_VALUES, way.data());
    way[RATIO] = 1;
    ReadoutEvidence evidence;
    for (int step = 0; step < 3; step++)
    {
        const Gradient ofModel = J * way;
        NormalEquations<PARAMETERS + 1> sums;
        evidence = ReadoutEvidence();
        for (size_t i = 0; i < slants.size(); i++)
        {
            const Slant& s = slants[i];
            const double slant = s.value + (about - 1) * s.by.dot(ofModel),
                         weight = weights[i] * loss.slope(slant * slant);
            sums.information += weight * s.by * s.by.transpose();
            sums.gradient += weight * s.value * s.by;
            evidence.weight += weight;
        }
        const ReadoutEquations::Matrix information = others.symmetric() + J.transpose() * sums.information * J;
        const ReadoutEquations::Vector gradient = others.gradient + J.transpose() * sums.gradient;
        const Eigen::Matrix<double, FLOW_VALUES, FLOW_VALUES> ofState =
            information.topLeftCorner<FLOW_VALUES, FLOW_VALUES>();
        way.head<FLOW_VALUES>() = -scaledInverse(ofState) * information.col(RATIO).head<FLOW_VALUES>();
        evidence.information = information.row(RATIO).dot(way);
        evidence.weighed = evidence.information - gradient.dot(way);
    }
    std::copy(way.data(), way.data() + SEQUENCE_VALUES, byReadout.val);
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

double ReadoutRatio::scatter() const
{
    if (count < MOST_PARTS / 2 || !(sum.information > 0))
        return 0;
    double squares = 0;
    for (int i = 0; i < count; i++)
        squares += std::pow(parts[i].weighed - shown() * parts[i].information, 2);
    // By the variance of Student's distribution, (n - 1) / (n - 3).
    const double byParts = std::sqrt(squares * count / (count - 3)) / sum.information,
                 byLeans = LEAN_SIGMA * std::sqrt(sum.weight / sum.information);
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
