//! Saved states of motions, as plain numbers.

use crate::Error;
use crate::group::{ExtendedPose, LieGroup};
use crate::mechanics::integrators::KinematicState;
use crate::mechanics::systems::isospectral::Entry;
use crate::mechanics::{ConstrainedState, MatrixState, State};
use nalgebra::{
    AbstractRotation, Complex, DMatrix, DVector, Isometry, Quaternion, SMatrix, SVector, Scalar,
    UnitComplex, UnitQuaternion,
};

/// A state of a motion with all that its continuation depends on, exact to the last bit.
///
/// With the feature `serde` it can be written to a file and read back.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Snapshot {
    /// Times, coordinates, momenta and step sizes.
    numbers: Vec<f64>,
    /// Numbers of steps and sizes of matrices.
    counts: Vec<u64>,
}

/// Reads a [`Snapshot`] in the order in which it was written.
#[derive(Clone, Debug)]
pub struct Reader<'s> {
    numbers: &'s [f64],
    counts: &'s [u64],
}

impl Snapshot {
    /// The snapshot of a value.
    ///
    /// # Errors
    /// [`Error::Snapshot`] for a number that is not finite.
    pub(super) fn of(value: &impl Saved) -> Result<Self, Error> {
        let mut snapshot = Snapshot::default();
        value.save(&mut snapshot);
        match snapshot.numbers.iter().find(|number| !number.is_finite()) {
            None => Ok(snapshot),
            Some(number) => Err(Error::Snapshot { reason: format!("it has the number {number}") }),
        }
    }

    /// The value that was saved; `None` if the snapshot is not that of such a value.
    pub(super) fn read<T: Saved>(&self) -> Option<T> {
        let mut reader = Reader { numbers: &self.numbers, counts: &self.counts };
        let value = T::read(&mut reader)?;
        (reader.numbers.is_empty() && reader.counts.is_empty()).then_some(value)
    }
}

impl<'s> Reader<'s> {
    /// The next numbers; `None` if there are fewer.
    fn take(&mut self, count: usize) -> Option<&'s [f64]> {
        let (numbers, rest) = self.numbers.split_at_checked(count)?;
        self.numbers = rest;
        Some(numbers)
    }
}

/// A value that can be saved as numbers and read back, to the last bit.
pub trait Saved: Sized {
    /// Appends its numbers.
    fn save(&self, snapshot: &mut Snapshot);

    /// Reads them again; `None` if they are not those of such a value.
    fn read(reader: &mut Reader) -> Option<Self>;
}

impl Saved for f64 {
    fn save(&self, snapshot: &mut Snapshot) {
        snapshot.numbers.push(*self);
    }

    fn read(reader: &mut Reader) -> Option<Self> {
        reader.take(1).map(|numbers| numbers[0])
    }
}

impl Saved for u64 {
    fn save(&self, snapshot: &mut Snapshot) {
        snapshot.counts.push(*self);
    }

    fn read(reader: &mut Reader) -> Option<Self> {
        let (first, rest) = reader.counts.split_first()?;
        reader.counts = rest;
        Some(*first)
    }
}

impl Saved for usize {
    fn save(&self, snapshot: &mut Snapshot) {
        (*self as u64).save(snapshot);
    }

    fn read(reader: &mut Reader) -> Option<Self> {
        usize::try_from(u64::read(reader)?).ok()
    }
}

/// The number of values, 0 or 1, before the value.
impl<T: Saved> Saved for Option<T> {
    fn save(&self, snapshot: &mut Snapshot) {
        u64::from(self.is_some()).save(snapshot);
        self.iter().for_each(|value| value.save(snapshot));
    }

    fn read(reader: &mut Reader) -> Option<Self> {
        match u64::read(reader)? {
            0 => Some(None),
            1 => T::read(reader).map(Some),
            _ => None,
        }
    }
}

impl<A: Saved, B: Saved> Saved for (A, B) {
    fn save(&self, snapshot: &mut Snapshot) {
        self.0.save(snapshot);
        self.1.save(snapshot);
    }

    fn read(reader: &mut Reader) -> Option<Self> {
        Some((A::read(reader)?, B::read(reader)?))
    }
}

impl<const R: usize, const C: usize> Saved for SMatrix<f64, R, C> {
    fn save(&self, snapshot: &mut Snapshot) {
        snapshot.numbers.extend_from_slice(self.as_slice());
    }

    fn read(reader: &mut Reader) -> Option<Self> {
        reader.take(R * C).map(SMatrix::from_column_slice)
    }
}

/// Rows and columns before the entries, column by column.
impl<T: Saved + Scalar> Saved for DMatrix<T> {
    fn save(&self, snapshot: &mut Snapshot) {
        self.shape().save(snapshot);
        self.iter().for_each(|entry| entry.save(snapshot));
    }

    fn read(reader: &mut Reader) -> Option<Self> {
        let (rows, columns) = <(usize, usize)>::read(reader)?;
        let size = rows.checked_mul(columns).filter(|size| *size <= reader.numbers.len())?;
        let entries: Option<Vec<T>> = (0..size).map(|_| T::read(reader)).collect();
        Some(DMatrix::from_vec(rows, columns, entries?))
    }
}

impl Saved for DVector<f64> {
    fn save(&self, snapshot: &mut Snapshot) {
        self.len().save(snapshot);
        snapshot.numbers.extend_from_slice(self.as_slice());
    }

    fn read(reader: &mut Reader) -> Option<Self> {
        let count = usize::read(reader)?;
        reader.take(count).map(DVector::from_column_slice)
    }
}

impl Saved for UnitComplex<f64> {
    fn save(&self, snapshot: &mut Snapshot) {
        self.as_ref().save(snapshot);
    }

    fn read(reader: &mut Reader) -> Option<Self> {
        Complex::read(reader).map(UnitComplex::new_unchecked)
    }
}

impl Saved for UnitQuaternion<f64> {
    fn save(&self, snapshot: &mut Snapshot) {
        self.coords.save(snapshot);
    }

    fn read(reader: &mut Reader) -> Option<Self> {
        let coords = Saved::read(reader)?;
        Some(UnitQuaternion::new_unchecked(Quaternion { coords }))
    }
}

impl<R: Saved + AbstractRotation<f64, D>, const D: usize> Saved for Isometry<f64, R, D> {
    fn save(&self, snapshot: &mut Snapshot) {
        self.rotation.save(snapshot);
        self.translation.vector.save(snapshot);
    }

    fn read(reader: &mut Reader) -> Option<Self> {
        let (rotation, vector): (R, SVector<f64, D>) = Saved::read(reader)?;
        Some(Isometry::from_parts(vector.into(), rotation))
    }
}

/// Saves structs field by field: `saved!([generics] Type: fields)`.
macro_rules! saved {
    ($([$($generics:tt)*] $type:ty: $($field:ident),+;)+) => {$(
        impl<$($generics)*> $crate::mechanics::motions::Saved for $type {
            fn save(&self, snapshot: &mut $crate::mechanics::motions::Snapshot) {
                $(self.$field.save(snapshot);)+
            }

            fn read(reader: &mut $crate::mechanics::motions::Reader) -> Option<Self> {
                Some(Self { $($field: $crate::mechanics::motions::Saved::read(reader)?),+ })
            }
        }
    )+};
}
pub(super) use saved;

saved! {
    [T: Saved + Scalar] Complex<T>: re, im;
    [] ExtendedPose: attitude, velocity, position;
    [G: LieGroup<Element: Saved>] KinematicState<G>: time, element;
    [G: LieGroup<Element: Saved, Vector: Saved>] State<G>: time, element, spatial;
    [G: LieGroup<Element: Saved, Vector: Saved>] ConstrainedState<G>:
        time, element, velocity, acceleration, multipliers, lead;
    [T: Saved + Entry] MatrixState<T>: time, matrix;
}
