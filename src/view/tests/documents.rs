use super::small;
use crate::graph::{Edit, Frame};
use crate::semantic::Value;
use crate::view::Document;

fn document() -> Document {
    Document::new(small(&["a k", "b k"], &["a -> b"]))
}

fn set(value: f64) -> Edit {
    Edit::SetParam { node: "a".into(), param: "x".into(), value: Some(Value::Numbers(vec![value])) }
}

fn at(x: f64) -> Edit {
    Edit::Move("a".into(), Some([x, 0.0]))
}

#[test]
fn steps_are_taken_back_and_made_again() {
    let mut document = document();
    let start = document.text();
    document.change("Rename", Edit::RenameNode("a".into(), "c".into())).unwrap();
    document.change("Delete", Edit::RemoveNode("c".into())).unwrap();
    assert!(document.change("Wrong", Edit::RemoveNode("c".into())).is_err());
    let end = document.text();
    assert_eq!(document.history().collect::<Vec<_>>(), ["Rename", "Delete"]);
    assert_eq!(
        (document.undo().as_deref(), document.undo().as_deref(), document.undo()),
        (Some("Delete"), Some("Rename"), None)
    );
    assert_eq!(document.text(), start);
    assert_eq!((document.undo_label(), document.redo_label()), (None, Some("Rename")));
    assert_eq!(
        (document.redo().as_deref(), document.redo().as_deref(), document.redo()),
        (Some("Rename"), Some("Delete"), None)
    );
    assert_eq!(document.text(), end);
    document.undo();
    document.change("Name", Edit::SetName("n".into())).unwrap();
    assert_eq!(document.redo_label(), None);
}

#[test]
fn a_drag_is_one_step_that_keeps_one_inverse() {
    let mut document = document();
    let start = document.text();
    for x in 0..1000 {
        document.gesture("Move", "drag", at(f64::from(x))).unwrap();
    }
    assert_eq!(document.history().count(), 1);
    document.end_gesture();
    document.gesture("Move", "drag", at(7.0)).unwrap();
    document.gesture("Set", "slide", set(1.0)).unwrap();
    document.gesture("Set", "slide", Edit::Batch(vec![set(2.0), set(3.0), at(9.0)])).unwrap();
    assert_eq!(document.history().collect::<Vec<_>>(), ["Move", "Move", "Set"]);
    let end = document.text();
    document.undo();
    assert_eq!(document.graph().layout["a"], [7.0, 0.0]);
    assert!(document.graph().nodes["a"].params.is_empty());
    document.undo();
    document.undo();
    assert_eq!(document.text(), start);
    while document.redo().is_some() {}
    assert_eq!(document.text(), end);
}

#[test]
fn a_gesture_may_also_change_what_is_there() {
    let mut document = document();
    let start = document.text();
    for edit in [at(1.0), Edit::RenameNode("a".into(), "z".into()), Edit::Move("z".into(), Some([5.0, 5.0]))] {
        document.gesture("Odd", "k", edit).unwrap();
    }
    assert_eq!(document.history().count(), 1);
    document.undo();
    assert_eq!(document.text(), start);
    document.redo();
    assert_eq!(document.graph().layout["z"], [5.0, 5.0]);
}

#[test]
fn what_is_saved_is_known_across_undo() {
    let mut document = document();
    assert!(!document.is_changed());
    document.gesture("Move", "drag", at(1.0)).unwrap();
    document.mark_saved();
    assert!(!document.is_changed());
    document.gesture("Move", "drag", at(2.0)).unwrap();
    assert!(document.is_changed());
    document.undo();
    assert!(!document.is_changed());
    document.undo();
    assert!(document.is_changed());
    document.change("Other", at(4.0)).unwrap();
    document.undo();
    assert!(document.is_changed());
}

#[test]
fn revisions_say_what_has_to_be_made_anew() {
    let mut document = document();
    let mut check = |edit: Option<Edit>, value: bool, structure: bool| {
        let before = (document.revision(), document.value_revision(), document.structure_revision());
        match edit {
            Some(edit) => document.change("", edit).unwrap(),
            None => drop(document.undo().unwrap()),
        }
        assert_ne!(document.revision(), before.0);
        assert_eq!(
            (document.value_revision() != before.1, document.structure_revision() != before.2),
            (value, structure)
        );
    };
    check(Some(at(1.0)), false, false);
    check(Some(set(1.0)), true, true); // A default that the compiler provides may have been there before.
    check(Some(set(2.0)), true, false);
    check(None, true, false);
    let wide = Edit::SetParam { node: "a".into(), param: "x".into(), value: Some(Value::Numbers(vec![1.0, 2.0])) };
    check(Some(Edit::Batch(vec![at(3.0), wide])), true, true);
    check(None, true, true);
    let frame = Frame { size: [1.0, 1.0], ..Frame::default() };
    check(Some(Edit::SetFrame("f".into(), Some(Box::new(frame)))), false, false);
    check(Some(Edit::SetNodeNote("a".into(), "n".into())), false, false);
    check(Some(Edit::SetMuted("a".into(), true)), true, true);
}

#[test]
fn nothing_is_no_step_and_old_steps_are_forgotten() {
    let mut document = document();
    document.change("Nothing", Edit::Batch(vec![Edit::Batch(vec![])])).unwrap();
    assert_eq!((document.history().count(), document.revision()), (0, 0));
    for x in 0..10_050 {
        document.change("Move", at(f64::from(x))).unwrap();
    }
    assert_eq!(document.history().count(), 10_000);
    while document.undo().is_some() {}
    assert_eq!(document.graph().layout["a"], [49.0, 0.0]);
    assert!(document.is_changed());
}
