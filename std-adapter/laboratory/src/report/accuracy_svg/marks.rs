//! How each sort of filter is marked: by colour and by shape.

use crate::study::MeasuredFilter;
use selvedge_core::filter::Tier;
use svg::Node;
use svg::node::element::{Circle, Group, Path, Polygon};

/// A sort of filter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// By rounded arithmetic and a bound.
    Certified,
    /// The same, one pair at a time.
    OneAtATime,
    /// By exact arithmetic.
    Exact,
    /// In parts of the step.
    Subdivided,
    /// Unsafe.
    Uncertified,
}

const RADIUS: f64 = 5.0;

impl Kind {
    pub(super) const ALL: [Self; 5] = [
        Self::Certified,
        Self::OneAtATime,
        Self::Exact,
        Self::Subdivided,
        Self::Uncertified,
    ];

    pub(super) fn of(filter: MeasuredFilter) -> Self {
        match filter {
            MeasuredFilter::Tier(Tier::Subdivided(_)) => Self::Subdivided,
            MeasuredFilter::Tier(Tier::Exact) => Self::Exact,
            filter if filter.is_certified() => Self::Certified,
            _ => Self::Uncertified,
        }
    }

    pub(super) fn legend(self) -> &'static str {
        match self {
            Self::Certified => "certified",
            Self::OneAtATime => "certified, one by one",
            Self::Exact => "exact",
            Self::Subdivided => "certified, in parts of the step (+: culled beyond exact signs)",
            Self::Uncertified => "unsafe: culls without proof",
        }
    }

    /// From Okabe and Ito's colours, which people who confuse colours tell apart.
    pub(super) fn colour(self) -> &'static str {
        match self {
            Self::Certified | Self::OneAtATime => "#0072b2",
            Self::Exact => "#007a58",
            Self::Subdivided => "#a8508a",
            Self::Uncertified => "#d55e00",
        }
    }

    /// The mark, with its middle at (`x`, `y`).
    pub(super) fn draw(self, group: &mut Group, x: f64, y: f64) {
        let colour = self.colour();
        let polygon = |points: &[[f64; 2]]| {
            let points = points.iter().map(|[dx, dy]| format!("{:.2},{:.2}", x + dx, y + dy));
            Polygon::new()
                .set("points", points.collect::<Vec<_>>().join(" "))
                .set("fill", colour)
        };
        let circle = Circle::new().set("cx", x).set("cy", y).set("r", RADIUS);
        let r = RADIUS;
        match self {
            Self::Certified => group.append(circle.set("fill", colour)),
            Self::OneAtATime => group.append(circle.set("fill", "#fdfdfc").set("stroke", colour).set("stroke-width", 2)),
            Self::Exact => {
                let r = 1.35 * r;
                group.append(polygon(&[[0.0, -r], [r, 0.0], [0.0, r], [-r, 0.0]]));
            }
            Self::Subdivided => {
                group.append(polygon(&[[0.0, -1.25 * r], [1.2 * r, 0.9 * r], [-1.2 * r, 0.9 * r]]));
            }
            Self::Uncertified => {
                let cross = Path::new()
                    .set(
                        "d",
                        format!(
                            "M{:.2} {:.2}L{:.2} {:.2}M{:.2} {:.2}L{:.2} {:.2}",
                            x - r,
                            y - r,
                            x + r,
                            y + r,
                            x - r,
                            y + r,
                            x + r,
                            y - r,
                        ),
                    )
                    .set("stroke", colour)
                    .set("stroke-width", 3);
                group.append(cross);
            }
        }
    }
}
