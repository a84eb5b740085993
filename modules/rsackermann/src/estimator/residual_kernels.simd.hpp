// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY
#include "direction_terms.hpp"
#include "lanes.hpp"
#include "vertical_terms.hpp"
#endif
#include "residual_kernels.hpp"

namespace cv {
namespace rsackermann {

CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN

void addVerticals(const SegmentArrays& segments, const PreparedModel& model, const RobustLoss& loss, const FreeParameters& unknowns,
                  ResidualSums& sums);
void addDirections(const SegmentArrays& segments, const PreparedModel& model, const RobustLoss& loss, const FreeParameters& unknowns,
                   ResidualSums& sums);
double scoreVerticals(const SegmentArrays& segments, const PreparedModel& model, double focal, double threshold, double best, int& inliers);
void compensateSegments(const SegmentArrays& segments, const PreparedModel& model, double* points);
double streetCost(const double* points, int padded, double streetX, double streetZ, double scale);

#ifndef CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

namespace {

typedef LanesOf<double> Lanes;

template <class Number> LanesOf<Number> load(const SegmentArrays& segments, SegmentArrays::Field field, int i)
{
    return LanesOf<Number>::load(segments.at(field, Number()) + i);
}

template <class Number> TurnedEnd<LanesOf<Number> > endU(const SegmentArrays& s, int i, const PreparedModel& m)
{
    return TurnedEnd<LanesOf<Number> >(load<Number>(s, SegmentArrays::U_X, i), load<Number>(s, SegmentArrays::U_Y, i),
                                       load<Number>(s, SegmentArrays::TIME_U, i), m);
}

template <class Number> TurnedEnd<LanesOf<Number> > endV(const SegmentArrays& s, int i, const PreparedModel& m)
{
    return TurnedEnd<LanesOf<Number> >(load<Number>(s, SegmentArrays::V_X, i), load<Number>(s, SegmentArrays::V_Y, i),
                                       load<Number>(s, SegmentArrays::TIME_V, i), m);
}

// ResidualSums in vectors.
class Sums
{
public:
    Sums(const RobustLoss& loss, const FreeParameters& unknowns_)
        : unknowns(unknowns_), lossWeight(loss.weight), scale2(loss.scale2), cost(0.), weights(0.), influence2(0.), slopes(0.)
    {
        for (int i = 0; i < unknowns.count; i++)
        {
            gradient[i] = Lanes(0.);
            for (int j = 0; j <= i; j++)
                hessian[i][j] = Lanes(0.);
        }
    }

    // The residual scale * value of a segment; what fills the arrays has the scale 0.
    void add(const Lanes& value, const Lanes* by, const Lanes& scale)
    {
        const Lanes one(1), r = scale * value, r2 = r * r;
        // The weight of RobustLoss is its derivative by r^2; the influence is r * weight.
        const Lanes a = scale2 / (scale2 + r2), weight = choose(scale > Lanes(0.), lossWeight * a * a, Lanes(0.));
        cost = cost + lossWeight * r2 * a;
        weights = weights + weight;
        influence2 = influence2 + weight * weight * r2;
        slopes = slopes + weight * (one - Lanes(4) * (one - a));
        Lanes scaled[PARAMETERS];
        for (int i = 0; i < unknowns.count; i++)
        {
            scaled[i] = by[unknowns.index[i]] * scale;
            const Lanes weighted = scaled[i] * weight;
            gradient[i] = gradient[i] + weighted * r;
            for (int j = 0; j <= i; j++)
                hessian[i][j] = hessian[i][j] + weighted * scaled[j];
        }
    }

    void addTo(ResidualSums& sums) const
    {
        sums.cost += cost.sum();
        sums.weights += weights.sum();
        sums.influence2 += influence2.sum();
        sums.slopes += slopes.sum();
        for (int i = 0; i < unknowns.count; i++)
        {
            sums.gradient[i] += gradient[i].sum();
            for (int j = 0; j <= i; j++)
                sums.hessian[i][j] += hessian[i][j].sum();
        }
    }

private:
    const FreeParameters& unknowns;
    Lanes lossWeight, scale2, cost, weights, influence2, slopes;
    Lanes gradient[PARAMETERS], hessian[PARAMETERS][PARAMETERS];
};

} // namespace

void addVerticals(const SegmentArrays& segments, const PreparedModel& model, const RobustLoss& loss, const FreeParameters& unknowns,
                  ResidualSums& sums)
{
    const bool tilt = unknowns.hasTilt();
    Sums total(loss, unknowns);
    for (int i = 0; i < segments.size(); i += Lanes::COUNT)
    {
        const TurnedEnd<Lanes> u = endU<double>(segments, i, model), v = endV<double>(segments, i, model);
        const VerticalTerms<Lanes> residual(u, v, model);
        Lanes by[PARAMETERS];
        residual.derivatives(u, v, model, tilt, by);
        total.add(residual.value, by, load<double>(segments, SegmentArrays::SCALE, i));
    }
    total.addTo(sums);
}

void addDirections(const SegmentArrays& segments, const PreparedModel& model, const RobustLoss& loss, const FreeParameters& unknowns,
                   ResidualSums& sums)
{
    const bool tilt = unknowns.hasTilt();
    const Lanes streetX(model.streetX), streetZ(model.streetZ);
    Sums total(loss, unknowns);
    for (int i = 0; i < segments.size(); i += Lanes::COUNT)
    {
        const TurnedEnd<Lanes> u = endU<double>(segments, i, model), v = endV<double>(segments, i, model);
        const CompensatedEnd<Lanes> a(u, model), b(v, model);
        const DirectionTerms<Lanes> residual(Chord<Lanes>(a.x, a.y, b.x, b.y), streetX, streetZ);
        Lanes by[PARAMETERS];
        residual.derivatives(u, v, a, b, model, tilt, by);
        total.add(residual.value, by, load<double>(segments, SegmentArrays::SCALE, i));
    }
    total.addTo(sums);
}

// In single precision, which is 1e-4 pixels: a score only chooses among samples.
double scoreVerticals(const SegmentArrays& segments, const PreparedModel& model, double focal, double threshold, double best, int& inliers)
{
    typedef LanesOf<float> Vector;
    const Vector limit(threshold * threshold);
    const int betweenChecks = 4;
    double sum = 0, inside = 0;
    int i = 0;
    while (i < segments.size() && sum < best)
    {
        Vector part(0.), count(0.);
        for (int k = 0; k < betweenChecks && i < segments.size(); k++, i += Vector::COUNT)
        {
            const VerticalTerms<Vector> residual(endU<float>(segments, i, model), endV<float>(segments, i, model), model);
            const Vector r = residual.value * focal, r2 = r * r;
            part = part + choose(r2 < limit, r2, limit);
            count = count + choose(r2 < limit, Vector(1), Vector(0.));
        }
        sum += part.sum();
        inside += count.sum();
    }
    // What fills the arrays has no residual.
    inliers = cvRound(inside) - std::max(i - segments.size(), 0);
    return sum;
}

void compensateSegments(const SegmentArrays& segments, const PreparedModel& model, double* points)
{
    const int padded = segments.paddedSize();
    for (int i = 0; i < padded; i += Lanes::COUNT)
    {
        const CompensatedEnd<Lanes> a(endU<double>(segments, i, model), model), b(endV<double>(segments, i, model), model);
        a.x.store(points + i);
        a.y.store(points + padded + i);
        b.x.store(points + 2 * padded + i);
        b.y.store(points + 3 * padded + i);
    }
}

double streetCost(const double* points, int padded, double streetX, double streetZ, double scale)
{
    const Lanes x(streetX), z(streetZ), acrossX(-streetZ), scale2(scale * scale);
    Lanes sum(0.);
    for (int i = 0; i < padded; i += Lanes::COUNT)
    {
        const Chord<Lanes> chord(Lanes::load(points + i), Lanes::load(points + padded + i), Lanes::load(points + 2 * padded + i),
                                 Lanes::load(points + 3 * padded + i));
        // Squares, and fractions compared without division: this is done for many directions.
        Lanes along2, alongLength2, across2, acrossLength2;
        chord.momentAround(x, z, along2, alongLength2);
        chord.momentAround(acrossX, x, across2, acrossLength2);
        along2 = along2 * along2;
        across2 = across2 * across2;
        const Lanes::Mask isAlong = along2 * acrossLength2 < across2 * alongLength2;
        const Lanes moment2 = scale2 * choose(isAlong, along2, across2), length2 = choose(isAlong, alongLength2, acrossLength2);
        sum = sum + moment2 / (length2 + moment2);
    }
    return sum.sum();
}

#endif // CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

CV_CPU_OPTIMIZATION_NAMESPACE_END

}} // namespace cv::rsackermann
