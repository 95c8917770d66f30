//! The identity of a function: the key of records, and the columns of reports that say which function a row is about.

use core::fmt;

use serde::ser::SerializeMap;

use crate::generator::emit::{EmittedFunction, FunctionForm};
use crate::generator::reference::MaterialInMedium;
use crate::language::ir::Ty;
use crate::language::methods::Method;
use crate::physics::num::Precision;

/// Which function something is about.
#[derive(Clone, Debug)]
pub struct FunctionId {
    /// The function of an effect, by its name after the prefix.
    pub effect: Option<&'static str>,
    /// The method. None for a function of an effect that needs no R.
    pub method: Option<&'static Method>,
    /// The material that it is specialised to, as a user types it.
    pub material: Option<String>,
    /// Its form.
    pub form: FunctionForm,
    /// How many channels it returns.
    pub channels: usize,
    /// The precision that it computes in.
    pub precision: Precision,
}

impl FunctionId {
    /// A library function of a method.
    pub fn library(
        method: &'static Method,
        form: FunctionForm,
        precision: Precision,
    ) -> FunctionId {
        FunctionId {
            effect: None,
            method: Some(method),
            material: None,
            form,
            channels: if form.is_scalar() { 1 } else { 3 },
            precision,
        }
    }

    /// A function of a method that is specialised to a material.
    pub fn specialised(
        method: &'static Method,
        material: &MaterialInMedium,
        precision: Precision,
    ) -> FunctionId {
        FunctionId {
            material: Some(material.argument.clone()),
            ..FunctionId::library(method, FunctionForm::Specialised, precision)
        }
    }

    /// The identity of a function of a library file or of an effect's file.
    pub fn of_library_file(emitted: &EmittedFunction) -> FunctionId {
        let effect = emitted.effect.map(|part| part.function);
        let has_method = effect.is_none_or(|effect| effect.reflectance.is_used());
        let is_scalar = emitted.function.ty() == Ty::Scalar;
        FunctionId {
            effect: effect.map(|effect| effect.name),
            method: has_method.then_some(emitted.method),
            channels: if is_scalar { 1 } else { 3 },
            ..FunctionId::library(emitted.method, emitted.form, emitted.precision)
        }
    }

    /// The method's name, where it is part of the function.
    pub fn method_name(&self) -> Option<&'static str> {
        self.method.map(|method| method.name)
    }

    /// The function for people: `schlick`, `schlick, one channel`, `gold: schlick, f16`, `refracted`,
    /// `exit_transmittance: schlick`.
    pub fn label(&self) -> String {
        let of = self.material.as_deref().or(self.effect);
        let names: Vec<&str> = of.into_iter().chain(self.method_name()).collect();
        let channel = match self.channels {
            1 if self.method.is_some() => ", one channel",
            _ => "",
        };
        let half = if self.precision.is_half() {
            ", f16"
        } else {
            ""
        };
        format!("{}{channel}{half}", names.join(": "))
    }

    /// Writes the columns that rows of methods begin with.
    ///
    /// # Errors
    /// The serialiser refuses one.
    pub fn serialize_columns<Row: SerializeMap>(&self, row: &mut Row) -> Result<(), Row::Error> {
        row.serialize_entry("method", &self.method_name())?;
        row.serialize_entry("material", &self.material)?;
        row.serialize_entry("form", &self.form)?;
        row.serialize_entry("channels", &self.channels)?;
        row.serialize_entry("precision", &self.precision)
    }
}

impl fmt::Display for FunctionId {
    /// The first columns of a record, which are its key. A column is empty where there is nothing.
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let effect = self.effect.unwrap_or_default();
        let method = self.method_name().unwrap_or_default();
        let material = self.material.as_deref().unwrap_or_default();
        let (form, channels) = (self.form.name(), self.channels);
        let precision = self.precision.name();
        write!(
            to,
            "{effect},{method},{material},{form},{channels},{precision}"
        )
    }
}
