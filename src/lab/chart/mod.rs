//! Error against cost as data: every method is a point, as is a user's function if there is one, with the Pareto frontier. Pages
//! and pictures of it are made in `pictures/frontier.rs`.

mod audited;
mod data;
mod recorded;
mod sets;
mod view;

pub use audited::charted_function;
pub use data::{chart_data, cost_names, error_rows, intended_data};
pub use recorded::RecordedErrors;
pub use sets::{STATISTICS, set_name};
pub use view::{
    ChartData, ChartEntry, ChartPoint, ChartView, CostAxis, ERRORS, ErrorAxis, FunctionOrigin,
    LEAST_ERROR, drawn, without_point,
};
