//! Error against cost as data: every method is a point, as is a user's function if there is one, with the Pareto frontier. Pages
//! and pictures of it are made in `pictures/frontier/`.

mod audited;
mod data;
mod left_out;
mod sets;
mod view;

pub use audited::{ChartedFunction, charted_function};
pub use data::{chart_data, cost_names};
pub use left_out::{LeftOutErrors, left_out};
pub use sets::{MaterialSet, STATISTICS, set_name};
pub use view::{
    ChartData, ChartEntry, ChartPoint, ChartView, CostAxis, ERRORS, ErrorAxis, FunctionOrigin,
    LEAST_ERROR, PointRow, UserFunction, drawn, without_point,
};
