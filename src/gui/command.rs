//! Everything that the editor can be told by key, menu or search: one table feeds them all, and the list of shortcuts.

use eframe::egui::{Key, KeyboardShortcut, Modifiers};

/// Where a command stands in the menus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Menu {
    File,
    Edit,
    Node,
    Arrange,
    View,
    Help,
}

impl Menu {
    /// In the order of the menu bar.
    pub(super) const ALL: [(Self, &'static str); 6] = [
        (Self::File, "File"),
        (Self::Edit, "Edit"),
        (Self::Node, "Node"),
        (Self::Arrange, "Arrange"),
        (Self::View, "View"),
        (Self::Help, "Help"),
    ];
}

/// What a command needs to make sense.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Needs {
    Nothing,
    /// A document.
    Document,
    /// At least one node that is selected.
    Selection,
    /// Something to take back.
    Undo,
    /// Something to do again.
    Redo,
    /// A link that is selected.
    Link,
    /// A selected node, or else a link.
    Anything,
}

macro_rules! commands {
    ($($name:ident $menu:ident $needs:ident $label:literal [$($key:expr),*] $help:literal;)*) => {
        /// Something that the editor can be told.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub(super) enum Command { $($name),* }

        impl Command {
            /// All of them, in the order of the menus.
            pub(super) const ALL: &[Self] = &[$(Self::$name),*];

            pub(super) const fn menu(self) -> Menu { match self { $(Self::$name => Menu::$menu),* } }
            pub(super) const fn needs(self) -> Needs { match self { $(Self::$name => Needs::$needs),* } }
            pub(super) const fn label(self) -> &'static str { match self { $(Self::$name => $label),* } }
            pub(super) const fn help(self) -> &'static str { match self { $(Self::$name => $help),* } }
            /// Any of these keys; the first is shown.
            pub(super) const fn keys(self) -> &'static [KeyboardShortcut] { match self { $(Self::$name => const { &[$($key),*] }),* } }
        }
    };
}

const fn plain(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::NONE, key)
}
const fn ctrl(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND, key)
}
const fn shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::SHIFT, key)
}
const fn ctrl_shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), key)
}
const fn alt(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::ALT, key)
}

commands! {
    New File Nothing "New" [ctrl(Key::N)] "Starts an empty graph.";
    Open File Nothing "Open…" [ctrl(Key::O)] "Opens a graph or a scene.";
    Gallery File Nothing "Examples…" [ctrl_shift(Key::O)] "Opens an example graph.";
    Save File Document "Save" [ctrl(Key::S)] "Writes the graph to its file.";
    SaveAs File Document "Save as…" [ctrl_shift(Key::S)] "Writes the graph to another file.";
    Reload File Document "Reload from disk" [] "Reads the file again; what was changed here can be undone back to.";
    Figure File Document "Export figure…" [] "Writes tree, code and picture as one SVG or PNG.";
    Close File Document "Close" [ctrl(Key::W)] "Closes the graph.";
    Quit File Nothing "Quit" [ctrl(Key::Q)] "Leaves the editor.";
    Undo Edit Undo "Undo" [ctrl(Key::Z)] "Takes the last step back.";
    Redo Edit Redo "Redo" [ctrl_shift(Key::Z), ctrl(Key::Y)] "Does again what was taken back.";
    Cut Edit Selection "Cut" [] "Copies the selected nodes and removes them. (Ctrl+X)";
    Copy Edit Selection "Copy" [] "Copies the selected nodes as text that pastes anywhere. (Ctrl+C)";
    Paste Edit Document "Paste" [] "Puts copied nodes down. (Ctrl+V)";
    Duplicate Edit Selection "Duplicate" [ctrl(Key::D)] "Copies the selected nodes beside themselves.";
    DuplicateLinked Edit Selection "Duplicate with inputs" [ctrl_shift(Key::D)] "As Duplicate; the copies keep what feeds them.";
    Delete Edit Anything "Delete" [plain(Key::Delete), plain(Key::Backspace)] "Removes the selected nodes, or the selected link.";
    DeleteHeal Edit Selection "Delete and heal" [ctrl(Key::Delete), shift(Key::Delete)] "Removes the selected nodes and joins what they joined.";
    SelectAll Edit Document "Select all" [ctrl(Key::A)] "Selects every node.";
    SelectNone Edit Document "Select nothing" [plain(Key::Escape)] "Selects nothing.";
    SelectUpstream Edit Selection "Select what feeds it" [ctrl(Key::L)] "Adds everything that feeds the selected nodes.";
    Find Edit Document "Find node…" [ctrl(Key::F)] "Goes to a node by its name.";
    Add Node Document "Add node…" [plain(Key::Tab), plain(Key::Space), shift(Key::A)] "Searches all kinds of nodes and puts one down.";
    Rename Node Selection "Rename" [plain(Key::F2)] "Gives the node another name.";
    Swap Node Selection "Swap for another kind…" [shift(Key::S)] "Puts another kind in its place and keeps its links.";
    Mute Node Selection "Mute" [plain(Key::M)] "Passes the selected nodes over, or no longer.";
    Collapse Node Selection "Collapse" [plain(Key::H)] "Draws the selected nodes small, or large again.";
    SetOutput Node Selection "Make it the output" [plain(Key::O)] "Lets the graph export this node.";
    Look Node Selection "Look at this node" [plain(Key::V)] "Shows this node's value in the preview, or no longer.";
    Subgraph Node Selection "Make subgraph…" [ctrl_shift(Key::G)] "Moves the selected nodes into a file of their own.";
    Enter Node Selection "Open subgraph" [plain(Key::Enter)] "Opens the file that the node stands for.";
    Leave Node Document "Back to outer graph" [alt(Key::ArrowUp)] "Goes back to the graph that this one was opened from.";
    Pin Node Link "Pin the link" [plain(Key::P)] "Writes the ports that the weaver chose into the link.";
    Bend Node Link "Bend the link" [ctrl(Key::R)] "Adds a bend that can be dragged; also by a double click.";
    Frame Arrange Document "Frame" [ctrl(Key::G)] "Draws a frame around the selected nodes, or an empty one.";
    ArrangeAll Arrange Document "Arrange all" [ctrl_shift(Key::L)] "Lays all nodes out anew, from left to right.";
    AlignLeft Arrange Selection "Align left" [alt(Key::L)] "Puts left edges on a line.";
    AlignTop Arrange Selection "Align top" [alt(Key::T)] "Puts top edges on a line.";
    AlignCenterX Arrange Selection "Centre in a column" [alt(Key::X)] "Puts middles on a vertical line.";
    AlignCenterY Arrange Selection "Centre in a row" [alt(Key::Y)] "Puts middles on a horizontal line.";
    DistributeX Arrange Selection "Space out across" [alt(Key::H)] "Makes gaps equal from left to right.";
    DistributeY Arrange Selection "Space out down" [alt(Key::V)] "Makes gaps equal from top to bottom.";
    MoveLeft Arrange Selection "Nudge left" [ctrl(Key::ArrowLeft)] "Moves the selected nodes by a grid step.";
    MoveRight Arrange Selection "Nudge right" [ctrl(Key::ArrowRight)] "Moves the selected nodes by a grid step.";
    MoveUp Arrange Selection "Nudge up" [ctrl(Key::ArrowUp)] "Moves the selected nodes by a grid step.";
    MoveDown Arrange Selection "Nudge down" [ctrl(Key::ArrowDown)] "Moves the selected nodes by a grid step.";
    Snap Arrange Nothing "Snap to grid" [] "Whether nodes are dragged from grid point to grid point.";
    FrameSelection View Document "Show selection" [plain(Key::F)] "Brings the selected nodes into view.";
    FrameAll View Document "Show all" [plain(Key::A), plain(Key::Home)] "Brings all nodes into view.";
    NextNode View Document "Next node" [plain(Key::ArrowRight), plain(Key::ArrowDown)] "Selects the next node along the links.";
    PreviousNode View Document "Previous node" [plain(Key::ArrowLeft), plain(Key::ArrowUp)] "Selects the node before along the links.";
    ZoomIn View Document "Zoom in" [ctrl(Key::Plus), ctrl(Key::Equals)] "Makes nodes larger.";
    ZoomOut View Document "Zoom out" [ctrl(Key::Minus)] "Makes nodes smaller.";
    Minimap View Nothing "Map of the graph" [] "Shows or hides the small map of all nodes.";
    Thumbnails View Nothing "Pictures on nodes" [ctrl(Key::T)] "Shows what each node makes, on the node.";
    CostOverlay View Nothing "Cost on nodes" [ctrl(Key::K)] "Shows what each node costs, on the node.";
    Outline View Nothing "Outline" [ctrl(Key::Num1)] "Shows or hides the list of nodes and links.";
    Bottom View Nothing "Text, problems and cost" [ctrl(Key::Num2)] "Shows or hides the lower panel.";
    Side View Nothing "Preview and values" [ctrl(Key::Num3)] "Shows or hides the right panel.";
    Pause View Nothing "Pause the preview" [ctrl(Key::Period)] "Stops or resumes the preview.";
    NextTab View Document "Next graph" [ctrl(Key::Tab)] "Goes to the next open graph.";
    Theme View Nothing "Dark or light" [] "Changes between dark and light.";
    Larger View Nothing "Larger interface" [ctrl_shift(Key::Plus)] "Makes everything larger.";
    Smaller View Nothing "Smaller interface" [ctrl_shift(Key::Minus)] "Makes everything smaller.";
    NodeHelp Help Document "About this node" [plain(Key::F1)] "Tells what the selected node does.";
    Shortcuts Help Nothing "Shortcuts" [ctrl(Key::Slash)] "Lists all shortcuts.";
    Commands Help Nothing "All commands…" [ctrl_shift(Key::P)] "Searches all commands and runs one.";
    Welcome Help Nothing "First steps" [] "Shows how to build a first graph.";
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two commands on one key would shadow each other.
    #[test]
    fn each_key_means_one_thing() {
        let mut seen: Vec<(KeyboardShortcut, Command)> = Vec::new();
        for command in Command::ALL {
            for key in command.keys() {
                if let Some((_, other)) = seen.iter().find(|(k, _)| k == key) {
                    panic!("{key:?} is {other:?} and {command:?}");
                }
                seen.push((*key, *command));
            }
        }
    }

    #[test]
    fn every_command_says_what_it_does() {
        for command in Command::ALL {
            assert!(command.help().ends_with('.') || command.help().ends_with(')'), "{command:?}");
            assert!(!command.label().is_empty());
        }
    }
}
